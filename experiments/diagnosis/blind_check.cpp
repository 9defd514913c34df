#include "experiments/diagnosis/blind_check.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <numeric>
#include <ostream>

#include "analysis/statistics/proportion.hpp"
#include "core/random.hpp"
#include "experiments/atomic_file.hpp"
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

fs::path file_of(const fs::path& folder, std::size_t number, const std::string& ending) {
  return folder / fmt::format("{:05}.{}", number, ending);
}

struct Label {
  std::size_t number;
  std::vector<std::string> effects;
  std::string strength;
};

std::vector<Label> open_labels(const fs::path& folder) {
  std::vector<Label> labels;
  for (const auto& entry : read_json((folder / "sealed_labels.json").string()))
    labels.push_back({entry.at("recording").get<std::size_t>(),
                      entry.at("effects").get<std::vector<std::string>>(),
                      entry.at("strength").get<std::string>()});
  return labels;
}

TableCell share(double hits, double count) {
  if (count == 0.0) return {};
  const auto [low, high] = wilson_interval(hits, count, 0.95);
  return fmt::format("{:.0f} % ({:.0f} of {:.0f}; {:.0f} to {:.0f})", 100.0 * hits / count, hits, count,
                     100.0 * low, 100.0 * high);
}

double median(std::vector<double> values) {
  if (values.empty()) return no_value;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Runs a program to its end, what it says of errors in `log`; its status as waitpid tells it. Unlike
/// std::system it leaves this process its own signals.
int run_process(std::vector<std::string> arguments, const std::string& log) {
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t child = 0;
  const int failed = posix_spawn(&child, argv[0], &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return failed;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return status;
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

  std::vector<std::pair<std::string, BlindCase>> bare;
  if (!object.has("scenarios")) throw InputError(path, "\"scenarios\" is missing");
  for (const auto& [name, value] : json.at("scenarios").items()) {
    const std::string place = fmt::format("{}: scenarios.{}", path, name);
    BlindCase c{.effects = {}, .strength = "", .scenario = read_scenario({value, place}, fs::path(path).parent_path().string())};
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
      other = read_effect(second, entry.place_of("and"), entry.child("and_with").value_or(JsonObject(Json::object(), place)));
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
      throw InputError(place, "\"strong\", \"medium\" or \"weak\" is needed, an object of the effect's parameters");
  }
  object.finish();
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
  Json labels = Json::array();
  for (std::size_t i = 0; i < items.size(); ++i)
    labels.push_back({{"recording", order[i]}, {"effects", items[i].c->effects},
                      {"strength", items[i].c->strength}});
  std::sort(labels.begin(), labels.end(),
            [](const Json& a, const Json& b) { return a["recording"] < b["recording"]; });
  write_atomically(folder / "sealed_labels.json", labels.dump(0) + '\n');

  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    const auto path = file_of(folder / "recordings", order[i], "csv.gz");
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

bool diagnose_recordings(const BlindCheck& check, const fs::path& folder, const std::string& program,
                         std::ostream& log, const std::atomic<bool>& stop) {
  const auto labels = open_labels(folder);  // for the leave-one-out runs alone
  struct Job {
    std::size_t number;
    std::string without;
  };
  std::vector<Job> jobs;
  for (const auto& label : labels) {
    jobs.push_back({label.number, ""});
    if (check.left_out && label.effects.size() == 1 && label.strength == "strong")
      jobs.push_back({label.number, label.effects.front()});
  }
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    const auto& job = jobs[i];
    const auto out = file_of(folder / "diagnoses", job.number, job.without.empty() ? "json" : "without.json");
    if (!stop && !fs::exists(out)) {
      std::vector<std::string> arguments = {program, "diagnose",
                                            file_of(folder / "recordings", job.number, "csv.gz").string(),
                                            "--json", out.string()};
      if (!job.without.empty()) arguments.insert(arguments.end(), {"--without", job.without});
      const int status = run_process(arguments, out.string() + ".log");
      if (status != 0) {
        const std::scoped_lock lock(mutex);
        log << fmt::format("recording {:05}: the diagnosis ended with status {}; see {}.log\n", job.number,
                           status, out.string());
      }
    }
    const std::scoped_lock lock(mutex);
    if (++done % 50 == 0 || done == jobs.size())
      log << fmt::format("{} of {} diagnoses\n", done, jobs.size()) << std::flush;
  }, tbb::simple_partitioner());
  return !stop;
}

std::vector<Table> score_recordings(const BlindCheck& check, const fs::path& folder) {
  struct Tally {
    double count = 0, first = 0, both = 0, covered = 0, members = 0, unknown = 0, none = 0;
    double left_out = 0, abstained = 0;
    std::vector<double> closed;
    std::map<std::string, double> named;
  };
  std::map<std::pair<std::string, std::string>, Tally> tallies;  // strength, effects
  struct Calibration { double count = 0, stated = 0, right = 0; };
  std::array<Calibration, 5> calibration{};
  double missing = 0;
  for (const auto& label : open_labels(folder)) {
    const auto path = file_of(folder / "diagnoses", label.number, "json");
    if (!fs::exists(path)) {
      missing += 1;
      continue;
    }
    const Json d = read_json(path.string());
    const auto verdict = d.at("verdict").get<std::string>();
    const auto set = d.at("verdict_set").get<std::vector<std::string>>();
    const auto among = [&](const std::string& name) { return std::find(set.begin(), set.end(), name) != set.end(); };
    std::string effects = fmt::format("{}", fmt::join(label.effects, " + "));
    auto& t = tallies[{label.strength, effects.empty() ? "none" : effects}];
    t.count += 1;
    t.named[verdict] += 1;
    t.unknown += verdict == "unknown";
    t.none += verdict == "none";
    const std::string truth = label.effects.empty() ? "none" : label.effects.front();
    const bool right = label.effects.size() == 2
                           ? verdict == label.effects[0] || verdict == label.effects[1]
                           : verdict == truth;
    t.first += right;
    t.members += static_cast<double>(std::max<std::size_t>(set.size(), 1));
    t.covered += right || std::any_of(label.effects.begin(), label.effects.end(), among);
    t.closed.push_back(d.at("gap").at("closed").get<double>());
    if (label.effects.size() == 2) {
      double found = 0;
      for (const auto& step : d.at("steps"))
        for (const auto& effect : label.effects) found += step.at("added") == effect;
      t.both += found == 2;
    }
    if (label.effects.size() == 1)
      for (const auto& cause : d.at("causes")) {
        const double p = cause.at("probability").get<double>();
        auto& bin = calibration[std::min<std::size_t>(4, static_cast<std::size_t>(5.0 * p))];
        bin.count += 1;
        bin.stated += p;
        bin.right += cause.at("effect") == truth;
      }
    const auto without = file_of(folder / "diagnoses", label.number, "without.json");
    if (fs::exists(without)) {
      const Json w = read_json(without.string());
      t.left_out += 1;
      t.abstained += w.at("verdict") == "unknown" || w.at("verdict") == "none";
    }
  }

  Table cases{.title = check.title + ": by effect",
              .columns = {{"effect", ""}, {"strength", ""}, {"named first", ""}, {"in the set", ""},
                          {"members", ""}, {"median closed", "1"}, {"unknown", ""}, {"none", ""},
                          {"abstained without it", ""}, {"taken for", ""}},
              .rows = {}, .notes = {}};
  std::map<std::string, Tally> totals;
  for (const auto& [key, t] : tallies) {
    const auto& [strength, effects] = key;
    std::vector<std::string> others;
    for (const auto& [name, times] : t.named)
      if (name != effects) others.push_back(fmt::format("{} {:.0f}", name, times));
    cases.rows.push_back({effects, strength, share(t.first, t.count), share(t.covered, t.count),
                          t.members / t.count, cell(median(t.closed)), t.unknown, t.none,
                          share(t.abstained, t.left_out), fmt::format("{}", fmt::join(others, ", "))});
    const bool pair = effects.find(" + ") != std::string::npos;
    auto& total = totals[effects == "none" ? "none" : pair ? "two effects, " + strength : strength];
    total.count += t.count;
    total.first += t.first;
    total.both += t.both;
    total.covered += t.covered;
    total.members += t.members;
    total.left_out += t.left_out;
    total.abstained += t.abstained;
    total.closed.insert(total.closed.end(), t.closed.begin(), t.closed.end());
  }
  Table aims{.title = check.title,
             .columns = {{"recordings", ""}, {"named first", ""}, {"both named", ""}, {"in the set", ""},
                         {"members", ""}, {"median closed", "1"}, {"abstained without it", ""}},
             .rows = {}, .notes = {}};
  for (const auto& [name, t] : totals)
    aims.rows.push_back({name, share(t.first, t.count),
                         name.starts_with("two") ? share(t.both, t.count) : TableCell{},
                         share(t.covered, t.count), t.members / t.count, cell(median(t.closed)),
                         share(t.abstained, t.left_out)});
  aims.notes.push_back("shares with 95 % Wilson intervals, in %; for \"none\", named first is the share without a false alarm");
  if (missing > 0) aims.notes.push_back(fmt::format("{:.0f} recordings have no diagnosis", missing));
  Table trust{.title = check.title + ": are the probabilities right?",
              .columns = {{"stated", ""}, {"causes", ""}, {"mean stated", "1"}, {"right", ""}},
              .rows = {}, .notes = {}};
  for (std::size_t k = 0; k < calibration.size(); ++k) {
    const auto& c = calibration[k];
    trust.rows.push_back({fmt::format("{:.1f} to {:.1f}", 0.2 * static_cast<double>(k), 0.2 * static_cast<double>(k + 1)),
                          c.count, cell(c.count > 0 ? c.stated / c.count : no_value), share(c.right, c.count)});
  }
  return {aims, cases, trust};
}

}  // namespace gyrostat::gap
