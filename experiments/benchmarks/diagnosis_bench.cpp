#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {
namespace {

/// An hour at 100 Hz with temperature and heading, and with one effect or none.
Series recording(const std::vector<Effect>& effects) {
  Scenario scenario;
  scenario.sampling = {.duration_s = 3600.0, .rate_hz = 100.0};
  scenario.random_error = {0.5, 2e-5, 1e-5, 0.02};
  scenario.thermal_drift = {0.002, 0.1, -0.05};
  scenario.temperature = temperature::RampAndCooling{};
  scenario.compass.noise_std_deg = 0.05;
  scenario.effects = effects;
  Series series;
  synthesise(scenario, Noise{7, 0}, series);
  series.thermal_bias_dps.clear();
  series.random_error_dps.clear();
  return series;
}

/// Elapsed time with all threads; a counter for the seconds of each part, and the largest memory of
/// the process so far.
void diagnosis(benchmark::State& state, const std::vector<Effect>& effects) {
  const auto series = recording(effects);
  for (auto _ : state) {
    const auto found = gap::diagnose(series, {});
    for (const auto& [part, seconds] : found.seconds) state.counters[part].value += seconds;
  }
  for (auto& [name, counter] : state.counters) counter.flags = benchmark::Counter::kAvgIterations;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

BENCHMARK_CAPTURE(diagnosis, none, {})->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK_CAPTURE(diagnosis, thermal_hysteresis,
                  {effects::ThermalHysteresis{.amplitude_dps = 0.03}})
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(diagnosis, outliers, {effects::Outliers{}})
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace
}  // namespace gyrostat
