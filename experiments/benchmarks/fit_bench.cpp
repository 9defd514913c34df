#include <benchmark/benchmark.h>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/analysis/fits/arima_moments.hpp>
#include <gyrostat/generators/random_error.hpp>

namespace gyrostat {
namespace {

std::vector<double> signal(std::size_t samples) {
  const Arima111<double> model{0.9, 0.01, 0.002, 0.01};
  std::vector<double> z(samples);
  const Noise noise{1, 0};
  add_random_error(model, noise, z);
  add_white_noise(model.measurement_noise_std_dps, noise.stream("white_noise"), z);
  return z;
}

void likelihood_fit(benchmark::State& state) {
  const auto z = signal(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(fit_arima_likelihood(z));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(likelihood_fit)->Arg(6000)->Arg(60000)->Unit(benchmark::kMillisecond);

void moments_fit(benchmark::State& state) {
  const auto z = signal(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(fit_arima_moments(z));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(moments_fit)->Arg(6000)->Arg(60000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyrostat
