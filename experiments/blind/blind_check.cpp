#include <gyrostat/experiments/blind/blind_check.hpp>

#include <algorithm>
#include <mutex>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/run/process.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/recording.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

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

/// A folder holds the recordings of one check, for numbers mean nothing across two.
void claim(const fs::path& folder, const BlindCheck& check) {
  Json own = check.file;
  own["recordings"] = check.recordings;
  const auto path = folder / "sealed_check.json";
  if (!fs::exists(path))
    write_atomically(path, own.dump(1) + '\n');
  else if (read_json(path.string()) != own)
    throw InputError(folder.string(),
                     "the recordings there are of another check, see sealed_check.json; allowed: "
                     "that check, or another folder");
}

}  // namespace

void make_recordings(const BlindCheck& check, const fs::path& folder, const Interrupt& interrupt) {
  fs::create_directories(folder / "recordings");
  fs::create_directories(folder / "diagnoses");
  claim(folder, check);
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
    interrupt.check();
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
                         const std::string& program, const BlindWatcher& watcher,
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
          const int status = run_process(arguments, out.string() + ".log", stop);
          if (status != 0 && !stop) {
            const std::scoped_lock lock(mutex);
            watcher.say(
                fmt::format("recording {:05}: the diagnosis ended with status {}; see {}.log",
                            job.number, status, out.string()));
          }
        }
        if (stop) return;
        const std::scoped_lock lock(mutex);
        watcher.progress(++done, jobs.size());
      },
      tbb::simple_partitioner());
  return !stop;
}

}  // namespace gyrostat::gap
