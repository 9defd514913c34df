#pragma once

#include <span>

#include "analysis/fits/arima_fit.hpp"

namespace gyrostat {

/// Robust fit of ARIMA(1,1,1) + white noise to `rate_dps` (evenly sampled, static) by matching the
/// Allan variances at clusters 1, 2, 4, ... n/16: the generalised method of wavelet moments
/// (Guerrier, Skaloud, Stebler & Victoria-Feser, JASA 2013) in its robust form (Guerrier, Molinari
/// & Victoria-Feser 2014): spikes are taken out first and the variances are M-estimates.
///
/// The log variances are weighted by the inverse of their full covariance at the parameters found.
/// `standard_errors` come from it by the delta method, together with what the model itself says:
/// phi and theta lie in (-1, 1), a standard deviation of 0.58. So where phi and theta cannot be
/// told (delta2 = phi delta1 makes x a pure random walk; R can hide all of the short memory of x)
/// the fit converges to the smallest |phi|, |theta| that do, with standard errors near 0.58 and a
/// message that says so. `objective` is chi-square on (clusters - 4) degrees of freedom for a true
/// model; beyond its 99.9 % quantile the standard errors are enlarged by sqrt(objective / degrees).
///
/// Missing samples are bridged, which is harmless while they are few. Throws InputError for fewer
/// than 512 samples, more than 5 % of them missing, or a signal that hardly ever changes.
ArimaFit fit_arima_moments(std::span<const double> rate_dps);

}  // namespace gyrostat
