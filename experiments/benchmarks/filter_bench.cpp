#include <benchmark/benchmark.h>

#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {
namespace {

/// A minute at 100 Hz with temperature and compass, so that every filter has work to do.
const Series& bench_series() {
  static const Series series = [] {
    Scenario scenario;
    scenario.thermal_drift = {0.002, 0.1, -0.05};
    Series made;
    synthesise(scenario, {1, 0}, made);
    return made;
  }();
  return series;
}

template <class F>
void filter_step(benchmark::State& state) {
  const Series& series = bench_series();
  std::vector<Sample<double>> samples;
  for (std::size_t i = 0; i < series.size(); ++i) samples.push_back(sample_at(series, i));
  const F fresh{typename F::Parameters{}};
  for (auto _ : state) {
    F filter = fresh;
    for (const auto& sample : samples) benchmark::DoNotOptimize(filter.step(sample));
  }
  state.counters["s_per_step"] =
      benchmark::Counter(static_cast<double>(state.iterations() * samples.size()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const bool registered = [] {
  Filters::for_each([](auto plugin) {
    using F = typename decltype(plugin)::type;
    benchmark::RegisterBenchmark(("filter_step/" + std::string(plugin.id)).c_str(), filter_step<F>);
  });
  return true;
}();

void synthesised_sample(benchmark::State& state) {
  const Scenario scenario;
  Series series;
  std::uint32_t trial = 0;
  for (auto _ : state) synthesise(scenario, {1, trial++}, series);
  state.counters["s_per_sample"] =
      benchmark::Counter(static_cast<double>(state.iterations() * scenario.sampling.samples()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(synthesised_sample);

void normal_deviate(benchmark::State& state) {
  const NormalStream stream(1, 0, "bench");
  std::vector<double> block(4096);
  std::uint64_t first = 0;
  for (auto _ : state) {
    stream.fill(first, block);
    first += block.size();
    benchmark::DoNotOptimize(block.data());
  }
  state.counters["s_per_deviate"] =
      benchmark::Counter(static_cast<double>(state.iterations() * block.size()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(normal_deviate);

Cell bench_cell() {
  Cell cell;
  cell.name = "bench";
  for (const char* id : {"none", "kf", "stf", "sr_ukf", "sr_rsukf", "oracle"})
    cell.methods.push_back({id, id, ParameterSource::truth, {}, {}});
  return cell;
}

/// One minute at 100 Hz through none, kf, stf, sr_ukf, sr_rsukf and oracle, metrics included.
void trial(benchmark::State& state) {
  const Cell cell = bench_cell();
  std::vector<Workspace> workspace(1);
  std::uint32_t number = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(run_trial(cell, Calibration{}, 1, number++, workspace));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(trial)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyrostat
