// Packed kernels beside the same filters one trial at a time, an Eigen yardstick and the core's
// peak.

#include <map>

#include <benchmark/benchmark.h>

#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/experiments/benchmarks/counted.hpp>
#include <gyrostat/experiments/benchmarks/eigen_sr_ukf.hpp>
#include <gyrostat/experiments/benchmarks/peak.hpp>
#include <gyrostat/experiments/benchmarks/recursion.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/generators/random_error.hpp>

namespace gyrostat {

extern template double multiply_add_peak<targets::Sse2>(std::size_t, double, double);
extern template double recursion<targets::Sse2, filters::Kf, 8>(std::size_t, double);
extern template double recursion<targets::Sse2, filters::Stf, 8>(std::size_t, double);
extern template double multiply_add_peak<targets::Avx2>(std::size_t, double, double);
extern template double recursion<targets::Avx2, filters::Kf, 8>(std::size_t, double);
extern template double recursion<targets::Avx2, filters::Stf, 8>(std::size_t, double);
extern template double multiply_add_peak<targets::Avx512>(std::size_t, double, double);
extern template double recursion<targets::Avx512, filters::Kf, 8>(std::size_t, double);
extern template double recursion<targets::Avx512, filters::Stf, 8>(std::size_t, double);

namespace {

constexpr std::size_t samples = 6000;

void per(benchmark::State& state, const char* name, double count) {
  state.counters[name] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// A minute of the default gyro at rest.
Series signal(std::uint32_t trial) {
  Series series;
  synthesise(Scenario{}, {1, trial}, series);
  return series;
}

void peak(benchmark::State& state, double (*run)(std::size_t, double, double),
          std::size_t operations) {
  constexpr std::size_t rounds = 10'000;
  for (auto _ : state) benchmark::DoNotOptimize(run(rounds, 0.999, 0.001));
  state.counters["operations_per_s"] = benchmark::Counter(
      static_cast<double>(rounds * operations), benchmark::Counter::kIsIterationInvariantRate);
}

void recursion_alone(benchmark::State& state, double (*run)(std::size_t, double)) {
  for (auto _ : state) benchmark::DoNotOptimize(run(samples, 0.05));
  per(state, "s_per_trial_step", 8.0 * samples);
}

void eigen_yardstick(benchmark::State& state, bool risk) {
  const auto z = signal(0).gyro_dps;
  EigenSrUkf::State twice_mu = EigenSrUkf::State::Zero();
  twice_mu(2) = 0.04;
  for (auto _ : state) {
    EigenSrUkf filter{NlParameters<double>{}};
    for (const double value : z)
      benchmark::DoNotOptimize(filter.step(value, risk ? &twice_mu : nullptr));
  }
  per(state, "s_per_trial_step", samples);
}

/// Additions, multiplications, divisions and square roots of a step, on average over the signal.
template <class F>
double operations_per_step(const Series& series) {
  F filter{typename F::Parameters{}};
  Counted::operations = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    Sample<Counted> sample;
    sample.gyro_dps = series.gyro_dps[i];
    sample.true_rate_dps = series.rate_ref_dps[i];
    sample.true_drift_dps = series.thermal_bias_dps[i];
    filter.step(sample);
  }
  return static_cast<double>(Counted::operations) / static_cast<double>(series.size());
}

/// The filter as a study runs it one trial at a time: from a series into a track.
template <class F, class OnCounted>
void one_trial(benchmark::State& state) {
  const auto series = signal(0);
  state.counters["operations_per_step"] = operations_per_step<OnCounted>(series);
  Track track;
  for (auto _ : state) {
    run_filter(F{typename F::Parameters{}}, series, track);
    benchmark::ClobberMemory();
  }
  per(state, "s_per_trial_step", samples);
}

template <class F>
std::vector<double> default_parameters(std::size_t lanes) {
  std::vector<double> values;
  const typename F::Parameters p;
  for (const auto& field : p.fields()) values.insert(values.end(), lanes, p.*(field.member));
  return values;
}

/// The same for as many trials as there are lanes.
void packed(benchmark::State& state, const PackedFilter& kernel,
            const std::vector<double>& parameters) {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  std::vector<Series> series;
  std::vector<Track> tracks(lanes);
  std::vector<Lane> io;
  for (std::uint32_t l = 0; l < lanes; ++l) series.push_back(signal(l));
  for (std::size_t l = 0; l < lanes; ++l) {
    tracks[l].resize(samples);
    io.push_back({.gyro_dps = series[l].gyro_dps.data(),
                  .true_rate_dps = series[l].rate_ref_dps.data(),
                  .true_drift_dps = series[l].thermal_bias_dps.data(),
                  .estimate_dps = tracks[l].estimate_dps.data(),
                  .estimate_variance = tracks[l].estimate_variance.data(),
                  .innovation_dps = tracks[l].innovation_dps.data(),
                  .innovation_variance = tracks[l].innovation_variance.data(),
                  .status = tracks[l].status.data(),
                  .learned_first = &tracks[l].learned_first,
                  .learned_last = &tracks[l].learned_last});
  }
  for (auto _ : state) {
    kernel.run(parameters.data(), io.data(), samples);
    benchmark::ClobberMemory();
  }
  per(state, "s_per_trial_step", static_cast<double>(samples * lanes));
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
  const auto parameters = default_parameters<filters::SrUkf<double>>(lanes);
  const Arima111<double> model;
  std::vector<std::vector<double>> z(lanes, std::vector<double>(samples));
  std::vector<Track> tracks(lanes);
  std::uint32_t trial = 0;
  for (auto _ : state) {
    std::vector<Lane> io;
    for (std::size_t l = 0; l < lanes; ++l) {
      const Noise noise{1, trial++};
      std::fill(z[l].begin(), z[l].end(), 0.0);
      add_random_error(model, noise, z[l]);
      add_white_noise(model.measurement_noise_std_dps, noise.stream("white_noise"), z[l]);
      tracks[l].resize(samples);
      io.push_back({.gyro_dps = z[l].data(),
                    .estimate_dps = tracks[l].estimate_dps.data(),
                    .estimate_variance = tracks[l].estimate_variance.data(),
                    .innovation_dps = tracks[l].innovation_dps.data(),
                    .innovation_variance = tracks[l].innovation_variance.data(),
                    .status = tracks[l].status.data(),
                    .learned_first = &tracks[l].learned_first,
                    .learned_last = &tracks[l].learned_last});
    }
    kernel.run(parameters.data(), io.data(), samples);
    benchmark::ClobberMemory();
  }
  per(state, "s_per_trial_step", static_cast<double>(samples * lanes));
}

/// Processor time of a minute at 100 Hz through none, kf, stf, sr_ukf, sr_rsukf and oracle, metrics
/// included.
void study(benchmark::State& state) {
  Cell cell;
  cell.name = "bench";
  cell.trials = 1024;
  for (const char* id : {"none", "kf", "stf", "sr_ukf", "sr_rsukf", "oracle"})
    cell.methods.push_back({id, id, ParameterSource::truth, {}, {}});
  RunOptions options;
  options.threads = static_cast<int>(state.range(0));
  options.lanes = static_cast<std::uint32_t>(state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(run_cell(cell, 1, options));
  per(state, "s_per_trial", cell.trials);
}

/// `use(kernels, kernel)` for every packed filter that this machine can run.
template <class Use>
void for_each_kernel(const Use& use) {
  for (const auto* kernels : available_kernels())
    for (const auto* unit : kernels->filters)
      for (const auto& kernel : *unit) use(*kernels, kernel);
}

/// What is compiled for one instruction set here.
struct Compiled {
  double (*peak)(std::size_t, double, double);
  std::size_t operations;
  double (*kf)(std::size_t, double);
  double (*stf)(std::size_t, double);
};

template <class Target>
Compiled compiled_for() {
  return {&multiply_add_peak<Target>, operations_per_round<Target>,
          &recursion<Target, filters::Kf, 8>, &recursion<Target, filters::Stf, 8>};
}

const bool registered = [] {
  const std::map<std::string_view, Compiled> by_target = {
      {targets::Sse2::name, compiled_for<targets::Sse2>()},
      {targets::Avx2::name, compiled_for<targets::Avx2>()},
      {targets::Avx512::name, compiled_for<targets::Avx512>()}};
  using benchmark::RegisterBenchmark;
  const auto named = [](std::string what, std::string_view target, int lanes = 0) {
    what += "/" + std::string(target);
    if (lanes > 0) what += "/" + std::to_string(lanes);
    return what;
  };
  for (const auto* kernels : available_kernels()) {
    const auto& compiled = by_target.at(kernels->target);
    RegisterBenchmark(named("peak", kernels->target).c_str(), peak, compiled.peak,
                      compiled.operations);
    RegisterBenchmark(named("recursion/kf", kernels->target, 8).c_str(), recursion_alone,
                      compiled.kf);
    RegisterBenchmark(named("recursion/stf", kernels->target, 8).c_str(), recursion_alone,
                      compiled.stf);
    RegisterBenchmark(named("normals", kernels->target).c_str(), packed_normals, *kernels);
  }
  RegisterBenchmark("eigen/sr_ukf", eigen_yardstick, false);
  RegisterBenchmark("eigen/sr_rsukf", eigen_yardstick, true);
  Filters::for_each([&](auto plugin) {
    using F = typename decltype(plugin)::type;
    if constexpr (requires { F::packs_trials; }) {
      RegisterBenchmark(("filter/" + std::string(plugin.id) + "/one").c_str(),
                        one_trial<F, typename decltype(plugin)::template on<Counted>>);
      for_each_kernel([&](const Kernels& kernels, const PackedFilter& kernel) {
        if (kernel.filter == plugin.id)
          RegisterBenchmark(
              named("filter/" + std::string(plugin.id), kernels.target, kernel.lanes).c_str(),
              packed, kernel, default_parameters<F>(static_cast<std::size_t>(kernel.lanes)));
      });
    }
  });
  for_each_kernel([&](const Kernels& kernels, const PackedFilter& kernel) {
    if (kernel.filter == "sr_ukf")
      RegisterBenchmark(named("simulate_and_sr_ukf", kernels.target, kernel.lanes).c_str(),
                        simulate_and_filter, kernel);
  });
  for (const int threads : {1, 2})
    for (const int lanes : {1, 8})
      RegisterBenchmark("study", study)
          ->Args({threads, lanes})
          ->ArgNames({"threads", "lanes"})
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime();
  return true;
}();

}  // namespace
}  // namespace gyrostat
