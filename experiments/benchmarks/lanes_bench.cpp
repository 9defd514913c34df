// A trial in lanes: its parts, and all of it. Without templates of filters, so that it is quickly
// compiled.

#include <string>

#include <benchmark/benchmark.h>

#include <gyrostat/analysis/judge/judge.hpp>
#include <gyrostat/analysis/judge/kernels.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/held/kernels.hpp>
#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/experiments/benchmarks/counted.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/stretch.hpp>

namespace gyrostat {

template <>
struct Lanes<Counted> : Lanes<double> {
  static Counted load(const double* from) { return *from; }
  static void store(const Counted& value, double* to) { *to = value.value; }
  static double at(const Counted& value, int /*lane*/) { return value.value; }
};

namespace {

constexpr std::size_t samples = 6000;

void per(benchmark::State& state, const char* name, double count) {
  state.counters[name] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

std::vector<Noise> trials_from(std::uint32_t first, int lanes) {
  std::vector<Noise> trials;
  for (int l = 0; l < lanes; ++l) trials.push_back({1, first + static_cast<std::uint32_t>(l)});
  return trials;
}

/// Memory for the steps of a stretch.
struct Steps {
  PackMemory memory;
  PackedSteps to;

  explicit Steps(int lanes) {
    const std::size_t each = static_cast<std::size_t>(lanes) * JudgedSteps::most;
    double* at = memory.doubles(5 * each);
    to = {at, at + each, at + 2 * each, at + 3 * each, at + 4 * each};
  }
};

/// A minute of the default gyro through a kernel, from packs in memory.
void packed(benchmark::State& state, const PackedFilter& kernel) {
  const auto& type = filter_types().named(kernel.filter, "benchmark");
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  std::vector<double> parameters;
  for (const auto& field : type.fields) parameters.insert(parameters.end(), lanes, field.value);
  std::vector<double> gyro(samples * lanes), zero(samples * lanes);
  for (std::size_t l = 0; l < lanes; ++l) {
    Series series;
    synthesise(Scenario{}, {1, static_cast<std::uint32_t>(l)}, series);
    for (std::size_t k = 0; k < samples; ++k) gyro[k * lanes + l] = series.gyro_dps[k];
  }
  PackMemory memory;
  Steps steps(kernel.lanes);
  for (auto _ : state) {
    kernel.start(memory.bytes(kernel.bytes), parameters.data());
    for (std::size_t k = 0; k < samples; k += JudgedSteps::most)
      kernel.run(memory.bytes(), {&gyro[k * lanes], &zero[k * lanes], &zero[k * lanes]}, steps.to,
                 std::min(JudgedSteps::most, samples - k));
    benchmark::ClobberMemory();
  }
  per(state, "s_per_trial_step", static_cast<double>(samples * lanes));
}

/// Operations of a step of one trial, comparisons and selects left out.
double operations_of_judge(const JudgedSteps& steps) {
  judge::Judge<Counted> judge;
  judge.add(steps);  // the first stretch has no variance to compare with
  Counted::operations = 0;
  judge.add(steps);
  return static_cast<double>(Counted::operations) / static_cast<double>(steps.samples);
}

/// All metrics, of steps whose variances change (1) or have settled (0), or of a stretch without
/// innovations (2).
void judge(benchmark::State& state, const JudgeKernel& kernel) {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  PackMemory memory, inputs;
  constexpr std::size_t channels = 10;
  const std::size_t each = lanes * JudgedSteps::most;
  double* at = inputs.doubles(channels * each);
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<double> white(each);
    NormalStream(1, static_cast<std::uint32_t>(c), "judge").fill(0, white);
    for (std::size_t i = 0; i < each; ++i)
      at[c * each + i] = c == 6 || c == 8 ? (state.range(0) != 0 ? 1.0 + 1e-3 * white[i] : 1.0)
                         : c == 9         ? 0.0
                                          : white[i];
  }
  const JudgedSteps steps{JudgedSteps::most, at,
                          at + each,         at + 2 * each,
                          at + 3 * each,     at + 4 * each,
                          at + 5 * each,     at + 6 * each,
                          at + 7 * each,     at + 8 * each,
                          at + 9 * each};
  kernel.start(memory.bytes(kernel.bytes));
  if (state.range(0) == 2) {  // between epochs
    std::fill_n(at + 7 * each, 2 * each, no_value);
    std::fill_n(at + 9 * each, each, static_cast<double>(Status::no_measurement));
  }
  for (auto _ : state) kernel.add(memory.bytes(), steps);
  per(state, "s_per_trial_step", static_cast<double>(each));
  state.counters["operations_per_step"] = operations_of_judge(steps);
}

/// What thermal methods do between epochs: five operations, two loads and five stores a step.
void hold(benchmark::State& state, const HoldKernel& kernel) {
  const auto lanes = static_cast<std::size_t>(kernel.lanes), each = lanes * JudgedSteps::most;
  PackMemory memory;
  double* held = memory.doubles(held_numbers * lanes + 2 * each);
  std::fill_n(held, held_numbers * lanes, 0.0);
  std::fill_n(held + lanes, lanes, 1e300);  // never due
  Steps steps(kernel.lanes);
  double* t_s = held + held_numbers * lanes;
  std::fill_n(t_s, 2 * each, 1.0);
  for (auto _ : state) kernel.run(held, t_s, t_s + each, steps.to, JudgedSteps::most);
  per(state, "s_per_trial_step", static_cast<double>(each));
}

void packed_normals(benchmark::State& state, const Kernels& kernels) {
  const NormalAddress at{{1, 2}, 3, {4, 5}};
  std::vector<double> out(64 * 4 * normal_blocks);
  std::uint32_t first = 0;
  for (auto _ : state) {
    for (std::uint32_t g = 0; g < 64; ++g)
      kernels.normals(at, first + g * normal_blocks, &out[g * 4 * normal_blocks]);
    first += 64 * normal_blocks;
    benchmark::ClobberMemory();
  }
  per(state, "s_per_deviate", static_cast<double>(out.size()));
}

/// Signals of as many trials as there are lanes, and their SR-UKF.
void simulate_and_filter(benchmark::State& state, const PackedFilter& kernel) {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto& type = filter_types().named(kernel.filter, "benchmark");
  std::vector<double> parameters;
  for (const auto& field : type.fields) parameters.insert(parameters.end(), lanes, field.value);
  const Scenario scenario;
  const auto conditions = shared_conditions(scenario);
  PackMemory memory, signal;
  Steps steps(kernel.lanes);
  const std::size_t each = lanes * JudgedSteps::most;
  double* gyro = signal.doubles(2 * each);
  std::uint32_t trial = 0;
  for (auto _ : state) {
    const auto trials = trials_from(trial, kernel.lanes);
    trial += static_cast<std::uint32_t>(lanes);
    SignalInLanes made(scenario, *conditions, trials, *signal_kernel(kernel.lanes));
    kernel.start(memory.bytes(kernel.bytes), parameters.data());
    for (std::size_t k = 0; k < samples; k += JudgedSteps::most) {
      const std::size_t some = std::min(JudgedSteps::most, samples - k);
      made.gyro(k, some, gyro, gyro + each);
      kernel.run(memory.bytes(), {gyro}, steps.to, some);
    }
    benchmark::ClobberMemory();
  }
  per(state, "s_per_trial_step", static_cast<double>(samples * lanes));
}

Cell cell_of(std::uint32_t trials, std::initializer_list<const char*> methods) {
  Cell cell;
  cell.name = "bench";
  cell.trials = trials;
  for (const char* id : methods) cell.methods.push_back({id, id, ParameterSource::truth, {}, {}});
  return cell;
}

void run(benchmark::State& state, const Cell& cell) {
  RunOptions options;
  options.threads = static_cast<int>(state.range(0));
  options.lanes = static_cast<std::uint32_t>(state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(run_cell(cell, 1, options));
  per(state, "s_per_trial", cell.trials);
}

/// Processor time of a minute at 100 Hz through none, kf, stf, sr_ukf, sr_rsukf and oracle, metrics
/// included.
void study(benchmark::State& state) {
  run(state, cell_of(1024, {"none", "kf", "stf", "sr_ukf", "sr_rsukf", "oracle"}));
}

/// The same of an hour at 20 Hz through the thermal methods, with drift, curvature, hysteresis and
/// a disturbed compass.
void thermal(benchmark::State& state) {
  auto cell =
      cell_of(64, {"none", "thermal_mlr", "thermal_kf", "thermal_lsm", "thermal_stf", "oracle"});
  auto& s = cell.scenario;
  s.sampling = {.duration_s = 3600.0, .rate_hz = 20.0};
  s.random_error = {.phi = 0.5, .delta1_dps = 2e-5, .delta2_dps = 1e-5};
  s.random_error.measurement_noise_std_dps = 0.02;
  s.thermal_drift = {0.002, 0.1, -0.05};
  s.temperature = Temperature(temperature_types().named("ramp_and_cooling", "benchmark"));
  for (const char* id : {"thermal_curvature", "thermal_hysteresis"})
    s.effects.emplace_back(effect_types().named(id, "benchmark"));
  for (const double start_s : {600.0, 1500.0, 2400.0})
    s.compass.disturbances.push_back({.start_s = start_s});
  run(state, cell);
}

const bool registered = [] {
  using benchmark::RegisterBenchmark;
  for (const auto* kernels : available_kernels()) {
    const std::string target(kernels->target);
    RegisterBenchmark(("normals/" + target).c_str(), packed_normals, *kernels);
    for (const auto* unit : kernels->filters)
      for (const auto& kernel : *unit) {
        const auto at = target + "/" + std::to_string(kernel.lanes);
        RegisterBenchmark(("filter/" + std::string(kernel.filter) + "/" + at).c_str(), packed,
                          kernel);
        // signal_kernel is of the widest set that has so many lanes; a narrower one is not timed.
        if (kernel.filter == "sr_ukf" && packed_filter("sr_ukf", kernel.lanes) == &kernel)
          RegisterBenchmark(("simulate_and_sr_ukf/" + at).c_str(), simulate_and_filter, kernel);
      }
  }
  for (const int lanes : {1, 2, 4, 8, 16})
    if (const auto* kernel = judge_kernel(lanes))
      RegisterBenchmark(("judge/" + std::to_string(lanes)).c_str(), judge, *kernel)
          ->Arg(0)
          ->Arg(1)
          ->Arg(2)
          ->ArgName("changing");
  for (const int lanes : {2, 4, 8, 16})
    if (const auto* kernel = hold_kernel(lanes))
      RegisterBenchmark(("hold/" + std::to_string(lanes)).c_str(), hold, *kernel);
  for (const auto& [name, of] : {std::pair{"study", &study}, std::pair{"thermal", &thermal}})
    for (const auto& [threads, lanes] : {std::pair{1, 1}, {1, 2}, {1, 4}, {1, 8}, {2, 1}, {2, 8}})
      RegisterBenchmark(name, of)
          ->Args({threads, lanes})
          ->ArgNames({"threads", "lanes"})
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime();
  return true;
}();

}  // namespace
}  // namespace gyrostat
