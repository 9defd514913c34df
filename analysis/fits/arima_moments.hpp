#pragma once

#include <cstddef>
#include <span>

#include <gyrostat/analysis/fits/arima_fit.hpp>

namespace gyrostat {

inline constexpr std::size_t fewest_for_moments = 512;

/// Robust fit of ARIMA(1,1,1) + white noise to `rate_dps` (evenly sampled, static) by matching the
/// Allan variances at clusters 1, 2, 4, ... n/16: the generalised method of wavelet moments
/// (Guerrier, Skaloud, Stebler & Victoria-Feser, JASA 2013) in its robust form (Guerrier, Molinari
/// & Victoria-Feser, Austrian J. Statistics 2014): spikes are taken out first, and the variances
/// are M-estimates. The log variances weigh by the inverse of their full covariance at the fit.
///
/// `objective` is the misfit: chi-square on (clusters - 4) degrees of freedom if the model is true.
/// Standard errors are root mean square deviations from the fit under the quasi-posterior
/// exp(-objective / 2) (Chernozhukov & Hong, J. Econometrics 2003), parameters of |phi| < 1,
/// |delta2| < delta1, R > 0 being equally likely beforehand, sampled with a fixed seed. They are
/// enlarged by sqrt(objective / degrees) where the objective passes its 99.9 % quantile, of which
/// the message tells. Intervals of +-1.96 cover in 0.93 to 0.98 of simulations where R does not
/// hide the memory of x; delta1 and delta2 in 0.86 to 0.90 where it nearly does; an R of zero in
/// 0.78, as its root has no symmetric error.
///
/// phi and delta2 cannot be told where x is a random walk in effect: delta2 near phi delta1, or an
/// R that hides all memory. So unless the likelihood ratio against a random walk (phi = delta2 = 0)
/// passes its 99.9 % quantile the fit is that walk: converged, delta1 being its intensity, with a
/// standard error of phi of 0.4 to 0.6 and a message that says so.
///
/// Missing samples and spikes are bridged, which takes the noise of as many samples out of R.
/// Throws InputError for fewer than 512 samples, more than 5 % of them missing, or a signal that
/// hardly ever changes.
///
/// Example: a fit that spikes do not move, of every span that is long enough.
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 0}, series);
///   series.gyro_dps[100] = 1000.0;
///   const ArimaFit fit = fit_arima_moments(series.gyro_dps);
///   if (!fit.converged) std::puts(fit.message.c_str());
///
/// Thread safety: may run in any number of threads at once; it starts none.
ArimaFit fit_arima_moments(std::span<const double> rate_dps);

/// The same with phi and delta2 held at 0: a random walk in white noise.
ArimaFit fit_walk_moments(std::span<const double> rate_dps);

}  // namespace gyrostat
