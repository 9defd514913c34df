#include <cmath>
#include <cstdio>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/results/render/render.hpp>

/// Simulates a gyro, fits it, filters it, and prints its Allan deviation: one symbol from every
/// component that it asks for.
int main() {
  using namespace gyrostat;
  Scenario scenario;
  scenario.sampling = {.duration_s = 20, .rate_hz = 100};
  Series series;
  synthesise(scenario, {.seed = 1, .trial = 0}, series);

  const auto fit = fit_arima_likelihood(series.gyro_dps);
  filters::Kf<double> filter({fit.parameters, {}});
  double estimate = 0.0;
  for (const double z : series.gyro_dps) {
    filter.predict();
    estimate = filter.update(z).estimate_dps;
  }

  Table table{.title = "outside", .columns = {{"tau", "s"}, {"deviation", "dps"}}};
  for (const auto& point : overlapping_allan_deviation(series.gyro_dps, series.rate_hz()))
    table.rows.push_back({point.tau_s, point.deviation});
  std::printf("%s%zu filters, last estimate %g dps\n", render({&table, 1}, Format::text).c_str(),
              filter_types().ids().size(), estimate);
  return fit.converged && std::isfinite(estimate) && !table.rows.empty() ? 0 : 1;
}
