#include "experiments/diagnosis/blind_check.hpp"

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <numeric>
#include <ostream>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include "core/random.hpp"
#include "experiments/diagnosis/blind_labels.hpp"
#include "experiments/json_object.hpp"
#include "experiments/recording.hpp"
#include "experiments/study.hpp"

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

/// The default effect of that name with the parameters of `object`.
Effects::Any read_effect(const std::string& name, const std::string& place, JsonObject object) {
  Effects::Any effect;
  Effects::with(place, "effect", name, [&]<class Entry>(Entry /*entry*/) {
    typename Entry::type parameters;
    object.fields(parameters);
    effect = parameters;
  });
  object.finish();
  return effect;
}

/// The number that stands for recording `index` of all: a permutation drawn from the seed.
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  const NormalStream stream(seed, 0, "blind_check/order");
  std::vector<std::pair<double, std::size_t>> keys;
  for (std::size_t i = 0; i < count; ++i) keys.emplace_back(stream.uniform(i), i);
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order(count);
  for (std::size_t rank = 0; rank < count; ++rank) order[keys[rank].second] = rank;
  return order;
}

std::uint32_t recordings_of(const BlindCheck& check, const BlindCase& c) {
  return c.effects.empty() ? check.none_recordings : check.recordings;
}

fs::path recording_of(const fs::path& folder, std::size_t number) {
  return folder / "recordings" / fmt::format("{:05}.csv.gz", number);
}

/// Runs a program to its end, what it says of errors in `log`; its status as waitpid tells it.
/// Unlike std::system it leaves this process its own signals.
int run_process(std::vector<std::string> arguments, const std::string& log) {
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  pid_t child = 0;
  const int failed = posix_spawn(&child, argv[0], &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return failed;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::vector<BlindCase> at_each_duration(const std::vector<BlindCase>& cases,
                                        const std::vector<double>& durations_s) {
  std::vector<BlindCase> all;
  for (const double duration_s : durations_s)
    for (BlindCase c : cases) {
      c.scenario.sampling.duration_s = duration_s;
      all.push_back(std::move(c));
    }
  return all;
}

}  // namespace

BlindCheck read_blind_check(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  BlindCheck check;
  check.title = object.text("title", path);
  check.seed = static_cast<std::uint64_t>(object.number("seed", 1, ranges::count, ""));
  check.recordings = static_cast<std::uint32_t>(object.number("recordings", 10, ranges::count, ""));
  check.none_recordings =
      static_cast<std::uint32_t>(object.number("none_recordings", 40, ranges::count, ""));
  check.left_out = object.number("left_out", 1, ranges::flag, "") != 0.0;
  std::vector<double> durations_s;
  for (const auto& [value, place] : object.list("durations_s"))
    durations_s.push_back(JsonObject::checked_number(*value, place, ranges::positive, "s"));

  std::vector<std::pair<std::string, BlindCase>> bare;
  if (!object.has("scenarios")) throw InputError(path, "\"scenarios\" is missing");
  for (const auto& [name, value] : json.at("scenarios").items()) {
    const std::string place = fmt::format("{}: scenarios.{}", path, name);
    BlindCase c{.effects = {},
                .strength = "",
                .scenario = read_scenario({value, place}, fs::path(path).parent_path().string())};
    c.has_motion = value.contains("motion");
    bare.emplace_back(name, c);
    check.cases.push_back(c);
  }
  const auto scenario_named = [&](const std::string& name, const std::string& place) {
    std::vector<std::string> names;
    for (const auto& [known, c] : bare) {
      if (known == name) return c;
      names.push_back(known);
    }
    throw InputError(place, unknown_name("scenario", name, names));
  };
  for (const auto& [value, place] : object.list("cases")) {
    JsonObject entry(*value, place);
    const auto name = entry.required_text("effect");
    const auto base = scenario_named(entry.required_text("scenario"), entry.place_of("scenario"));
    const auto second = entry.text("and", "");
    std::optional<Effects::Any> other;
    if (!second.empty())
      other = read_effect(second, entry.place_of("and"),
                          entry.child("and_with").value_or(JsonObject(Json::object(), place)));
    for (const std::string strength : {"strong", "medium", "weak"}) {
      auto parameters = entry.child(strength);
      if (!parameters) continue;
      BlindCase c = base;
      c.effects = {name};
      c.strength = strength;
      c.scenario.effects.push_back(read_effect(name, entry.place_of("effect"), *parameters));
      if (other) {
        c.effects.push_back(second);
        c.scenario.effects.push_back(*other);
      }
      check.cases.push_back(std::move(c));
    }
    entry.finish();
    if (!value->contains("strong") && !value->contains("medium") && !value->contains("weak"))
      throw InputError(
          place,
          "\"strong\", \"medium\" or \"weak\" is needed, an object of the effect's parameters");
  }
  object.finish();
  if (!durations_s.empty()) check.cases = at_each_duration(check.cases, durations_s);
  return check;
}

void make_recordings(const BlindCheck& check, const fs::path& folder) {
  fs::create_directories(folder / "recordings");
  fs::create_directories(folder / "diagnoses");
  struct Item {
    const BlindCase* c;
    std::uint32_t trial;
  };
  std::vector<Item> items;
  std::uint32_t trial = 0;
  for (const auto& c : check.cases)
    for (std::uint32_t k = 0; k < recordings_of(check, c); ++k) items.push_back({&c, trial++});
  const auto order = shuffled(items.size(), check.seed);
  std::vector<BlindLabel> labels;
  for (std::size_t i = 0; i < items.size(); ++i)
    labels.push_back({order[i], items[i].c->effects, items[i].c->strength,
                      items[i].c->scenario.sampling.duration_s});
  std::sort(labels.begin(), labels.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  seal_labels(folder, labels);

  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    const auto path = recording_of(folder, order[i]);
    if (fs::exists(path)) return;
    Series series;
    synthesise(items[i].c->scenario, {check.seed, items[i].trial}, series);
    series.thermal_bias_dps.clear();
    series.random_error_dps.clear();
    series.mag_valid.clear();
    if (!items[i].c->has_motion) series.rate_ref_dps.clear();
    write_series(path, series);
  });
}

bool diagnose_recordings(const BlindCheck& check, const fs::path& folder,
                         const std::string& program, std::ostream& log,
                         const std::atomic<bool>& stop) {
  const auto labels = open_labels(folder);  // for the leave-one-out runs alone
  struct Job {
    std::size_t number;
    std::string without;
  };
  std::vector<Job> jobs;
  for (const auto& label : labels) {
    jobs.push_back({label.number, ""});
    if (check.left_out && label.is_strong_single())
      jobs.push_back({label.number, label.effects.front()});
  }
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      std::size_t{0}, jobs.size(),
      [&](std::size_t i) {
        const auto& job = jobs[i];
        const auto out = diagnosis_of(folder, job.number, !job.without.empty());
        if (!stop && !fs::exists(out)) {
          std::vector<std::string> arguments = {program, "diagnose",
                                                recording_of(folder, job.number).string(), "--json",
                                                out.string()};
          if (!job.without.empty()) arguments.insert(arguments.end(), {"--without", job.without});
          const int status = run_process(arguments, out.string() + ".log");
          if (status != 0) {
            const std::scoped_lock lock(mutex);
            log << fmt::format("recording {:05}: the diagnosis ended with status {}; see {}.log\n",
                               job.number, status, out.string());
          }
        }
        const std::scoped_lock lock(mutex);
        if (++done % 50 == 0 || done == jobs.size())
          log << fmt::format("{} of {} diagnoses\n", done, jobs.size()) << std::flush;
      },
      tbb::simple_partitioner());
  return !stop;
}

}  // namespace gyrostat::gap
