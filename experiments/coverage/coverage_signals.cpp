#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/experiments/coverage/coverage.hpp>
#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat::coverage_detail {
namespace {

constexpr double normal_95 = 1.959963984540054;

/// Estimates ± 1.96 standard errors against the truth; an infinite one says that there is none.
template <class P>
void add_parameters(Coverage& coverage, const P& fitted, const P& errors, const P& truth) {
  for (const auto& field : P::fields()) {
    const double error = errors.*(field.member), estimate = fitted.*(field.member);
    const double reach = std::isfinite(error) && error > 0.0 ? normal_95 * error : no_value;
    coverage.add(std::string(field.name), estimate - reach, truth.*(field.member),
                 estimate + reach);
  }
}

/// Whether a likelihood-ratio test rejects the truth, which is what the intervals are made of.
void add_profiles(Coverage& coverage, const std::vector<double>& rate,
                  const Arima111<double>& truth) {
  const ArimaIntervals likelihood(fit_arima_likelihood(rate), rate);
  int p = 0;
  for (const auto& field : Arima111<double>::fields()) {
    const auto parameter = static_cast<ArimaIntervals::Parameter>(p++);
    coverage.add(std::string(field.name), likelihood.holds(parameter, truth.*(field.member)));
  }
}

/// The expectation of the Allan variance at each cluster, by the mean over all signals.
std::vector<double> allan_variances(const Study& study, const Cell& cell, std::uint32_t signals) {
  std::vector<double> variances;
  Series series;
  for (std::uint32_t s = 0; s < signals; ++s) {
    make_trial(cell, study.seed, s, series);
    const auto points = overlapping_allan_deviation(series.gyro_dps, series.rate_hz());
    variances.resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      variances[p] += points[p].deviation * points[p].deviation / signals;
  }
  return variances;
}

bool is_stationary_noise(const Cell& cell) {
  const auto& drift = cell.scenario.thermal_drift;
  return drift.a_dps_per_C == 0.0 && drift.b_dps_s_per_C == 0.0;
}

}  // namespace

std::vector<Coverage> of_signals(const CoverageStudy& study, const Study& cells, const Cell& cell) {
  if (cell.fleet)
    throw InputError(cell.name, "draws its sensors from a fleet; coverage is of one sensor");
  const auto samples = static_cast<std::uint32_t>(cell.scenario.sampling.samples());
  const auto make = [&](const char* interval) {
    return Coverage{interval, cell.name, samples, {}};
  };
  Coverage likelihood = make("fit by likelihood (profile)");
  Coverage moments = make("fit by moments, ± 1.96 standard errors");
  Coverage drift = make("fit of thermal drift, ± 1.96 standard errors");
  Coverage allan = make("Allan deviation");
  Series series;
  for (std::uint32_t s = 0; s < study.fits; ++s) {
    make_trial(cell, cells.seed, s, series);
    if (is_stationary_noise(cell)) series.temperature_C.clear();  // no drift to regress on it first
    if (samples < 512) continue;
    const auto fit = calibrate(series, FitMethod::moments);
    if (fit.random_error.converged)
      add_parameters(moments, fit.random_error.parameters, fit.random_error.standard_errors,
                     cell.scenario.random_error);
    if (fit.thermal && !is_stationary_noise(cell))
      add_parameters(drift, fit.thermal->parameters, fit.thermal->standard_errors,
                     cell.scenario.thermal_drift);
    add_profiles(likelihood, without_drift(series, fit.thermal), cell.scenario.random_error);
  }
  if (is_stationary_noise(cell)) {
    const auto variances = allan_variances(cells, cell, study.fits);
    for (std::uint32_t s = 0; s < study.fits; ++s) {
      make_trial(cell, cells.seed, s, series);
      const auto points = overlapping_allan_deviation(series.gyro_dps, series.rate_hz());
      for (std::size_t p = 0; p < points.size(); ++p)
        allan.add(fmt::format("{:.3g} s", points[p].tau_s), points[p].lower,
                  std::sqrt(variances[p]), points[p].upper);
    }
  }
  return {likelihood, moments, drift, allan};
}

}  // namespace gyrostat::coverage_detail
