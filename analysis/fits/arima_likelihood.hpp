#pragma once

#include <span>

#include <gyrostat/analysis/fits/arima_fit.hpp>

namespace gyrostat {

/// Maximum-likelihood fit of ARIMA(1,1,1) + white noise to `rate_dps` (evenly sampled; NaN =
/// missing), by the prediction errors of the exact state-space model [METHODS sec. 4].
///
/// With the scale concentrated out, the likelihood is the least-squares problem
///   min sum_k (nu_k^2 / s_k) exp(mean log s),  s_k in units of delta1^2,
/// over phi, theta = delta2 / delta1 and log(sqrt(R) / delta1), which Ceres solves from the best
/// points of a grid. |theta| < 1: of the models with the same likelihood, the invertible one.
/// Standard errors are from the Fisher information at the optimum. Where that is singular - a
/// random walk hides phi and theta, a signal that is all white hides R - the simplest model that
/// the likelihood ratio does not reject (5 %) is given, the rest held at 0 with infinite standard
/// errors. Throws InputError for fewer than 50 samples or a signal that never changes.
///
/// Example: phi of a simulated gyro, with its standard error.
///
///   Scenario scenario;
///   scenario.random_error = {.phi = 0.5, .delta1_dps = 2e-3, .delta2_dps = 1e-3};
///   Series series;
///   synthesise(scenario, {.seed = 1, .trial = 0}, series);
///   const ArimaFit fit = fit_arima_likelihood(series.gyro_dps);
///   std::printf("%g +- %g\n", fit.parameters.phi, fit.standard_errors.phi);
///
/// Thread safety: may run in any number of threads at once; it starts none.
ArimaFit fit_arima_likelihood(std::span<const double> rate_dps);

/// The same with all four parameters, whether the signal tells them or not.
ArimaFit fit_whole_arima_likelihood(std::span<const double> rate_dps);

/// The same with phi and delta2 held at 0: a random walk in white noise.
ArimaFit fit_walk_likelihood(std::span<const double> rate_dps);

/// Log-likelihood of the diffuse model, for the parameters as given.
double arima_log_likelihood(const Arima111<double>& arima, std::span<const double> rate_dps);

}  // namespace gyrostat
