// What packed kernels are compared with: the same filters one trial at a time, an Eigen yardstick,
// the bare recursion and the core's peak.

#include <map>

#include <benchmark/benchmark.h>

#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/core/running_filter.hpp>
#include <gyrostat/experiments/benchmarks/counted.hpp>
#include <gyrostat/experiments/benchmarks/eigen_sr_ukf.hpp>
#include <gyrostat/experiments/benchmarks/peak.hpp>
#include <gyrostat/experiments/benchmarks/recursion.hpp>
#include <gyrostat/generators/scenario.hpp>

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
    RunningOf<F> filter(F{typename F::Parameters{}});
    run_to_the_end(filter, series, track);
    benchmark::ClobberMemory();
  }
  per(state, "s_per_trial_step", samples);
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
  for (const auto* kernels : available_kernels()) {
    const auto& compiled = by_target.at(kernels->target);
    const std::string target(kernels->target);
    RegisterBenchmark(("peak/" + target).c_str(), peak, compiled.peak, compiled.operations);
    RegisterBenchmark(("recursion/kf/" + target + "/8").c_str(), recursion_alone, compiled.kf);
    RegisterBenchmark(("recursion/stf/" + target + "/8").c_str(), recursion_alone, compiled.stf);
  }
  RegisterBenchmark("eigen/sr_ukf", eigen_yardstick, false);
  RegisterBenchmark("eigen/sr_rsukf", eigen_yardstick, true);
  Filters::for_each([&](auto plugin) {
    using F = typename decltype(plugin)::type;
    if constexpr (requires { F::packs_trials; })
      RegisterBenchmark(("filter/" + std::string(plugin.id) + "/one").c_str(),
                        one_trial<F, typename decltype(plugin)::template on<Counted>>);
  });
  return true;
}();

}  // namespace
}  // namespace gyrostat
