// Which filter should compensate this gyro? A scenario, the filters in question, trials, a ranking.
#include <cstdio>

#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/generators/effects/quantization.hpp>
#include <gyrostat/results/render/render.hpp>

int main() {
  using namespace gyrostat;

  // The gyro: correlated random error in white noise, read out on a grid of 0.01 dps.
  Cell cell;
  cell.name = "compare_filters";
  cell.scenario.sampling = {.duration_s = 20, .rate_hz = 100};
  cell.scenario.random_error = {
      .phi = 0.2, .delta1_dps = 4e-3, .delta2_dps = 3e-3, .measurement_noise_std_dps = 0.02};
  cell.scenario.effects.emplace_back(effects::Quantization{.lsb_dps = 0.01});

  // The filters, each with parameters fitted to a calibration signal, as an engineer would get
  // them. `none` is the gyro as it is, `oracle` knows what no gyro tells.
  for (const char* filter : {"none", "kf", "kf_ma", "stf", "oracle"}) {
    Method method;
    method.id = method.filter = filter;
    if (method.role().is_bound()) method.source = ParameterSource::truth;
    cell.methods.push_back(method);
  }

  // 200 trials: all filters see the same signals, and the same seed makes them again.
  cell.trials = 200;
  const CellResult result = run_cell(cell, /*seed=*/1, {});

  const CellRanking ranking = rank_cell(cell, result);
  const Table table = ranking_table(ranking);
  std::fputs(render({&table, 1}, Format::text).c_str(), stdout);
  return result.finished() == cell.trials ? 0 : 1;
}
