#include <gyrostat/experiments/blind/blind_check.hpp>

#include <algorithm>
#include <mutex>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/run/process.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

/// Which of all recordings is number 0, 1, …: a permutation drawn from the seed.
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  const NormalStream stream(seed, 0, "blind_check/order");
  std::vector<std::pair<double, std::size_t>> keys;
  for (std::size_t i = 0; i < count; ++i) keys.emplace_back(stream.uniform(i), i);
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& [key, index] : keys) order.push_back(index);
  return order;
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

/// What was there before it was rounded, as far as that is known: anywhere in its step, evenly. An
/// effect of less than a step put into what is rounded already would vanish, and a slow one become
/// steps.
void unround(Scenario& scenario, double step_dps, const Noise& noise) {
  auto dps = *scenario.recorded_noise_dps;
  const auto stream = noise.stream("blind_check/unrounded");
  for (std::size_t i = 0; i < dps.size(); ++i) dps[i] += step_dps * (stream.uniform(i) - 0.5);
  scenario.recorded_noise_dps = std::make_shared<const std::vector<double>>(std::move(dps));
}

}  // namespace

Series recorded(const BlindCase& c, const Noise& noise) {
  Series series;
  auto scenario = c.scenario;
  if (c.noise_step_dps > 0.0) unround(scenario, c.noise_step_dps, noise);
  synthesise(scenario, noise, series);
  series.thermal_bias_dps.clear();
  series.random_error_dps.clear();
  series.mag_valid.clear();
  if (!c.has_motion) series.rate_ref_dps.clear();
  if (!c.has_temperature) series.temperature_C.clear();
  if (!c.has_compass) series.heading_deg.clear();
  return series;
}

std::vector<BlindLabel> write_recordings(const BlindCheck& check,
                                         const std::vector<BlindCase>& cases,
                                         const fs::path& folder, const Interrupt& interrupt) {
  fs::create_directories(folder / "recordings");
  const auto order = shuffled(cases.size(), check.seed);
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t number) {
    const auto path = recording_of(folder, number);
    const auto index = order[number];
    interrupt.check();
    if (!fs::exists(path))
      write_series(path, recorded(cases[index], {check.seed, static_cast<std::uint32_t>(index)}));
  });
  std::vector<BlindLabel> labels;
  for (std::size_t number = 0; number < order.size(); ++number)
    labels.push_back(label_of(cases[order[number]], number));
  return labels;
}

void make_recordings(const BlindCheck& check, const fs::path& folder, const Interrupt& interrupt) {
  const auto cases = drawn_cases(check);
  fs::create_directories(folder / "diagnoses");
  claim(folder, check);
  seal_labels(folder, write_recordings(check, cases, folder, interrupt));
}

bool diagnose_recordings(const fs::path& folder, const std::string& program,
                         const BlindWatcher& watcher, const std::atomic<bool>& stop) {
  struct Job {
    std::size_t number;
    std::vector<std::string> without;
    bool left_out;
  };
  std::vector<Job> jobs;
  for (const auto& label : open_labels(folder)) {  // for what the simulator lacks alone
    jobs.push_back({label.number, label.without, false});
    if (label.left_out.empty()) continue;
    jobs.push_back({label.number, label.without, true});
    jobs.back().without.push_back(label.left_out);
  }
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      std::size_t{0}, jobs.size(),
      [&](std::size_t i) {
        const auto& job = jobs[i];
        const auto out = diagnosis_of(folder, job.number, job.left_out);
        if (!stop && !fs::exists(out)) {
          std::vector<std::string> arguments = {program, "diagnose",
                                                recording_of(folder, job.number).string(), "--json",
                                                out.string()};
          if (!job.without.empty())
            arguments.insert(arguments.end(),
                             {"--without", fmt::format("{}", fmt::join(job.without, ","))});
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
