#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <gyrostat/analysis/fits/arima_fit.hpp>

namespace gyrostat {

enum class FitMethod { likelihood, moments };

/// Samples over which means must be taken for their noise to be white, and the standard deviation
/// of the white noise of single samples that has the same density at low frequencies.
struct WhiteMeans {
  std::size_t cluster = 1;
  double white_std_dps = 0.0;
};

/// By where the robust Allan variance falls as that of white noise does, up to clusters of 128
/// samples; a cluster of 0 where it falls so nowhere.
WhiteMeans white_means(std::span<const double> rate_dps);

/// Fits ARIMA(1,1,1) + white noise by `method`, with the noise in R.
///
/// Noise that is not quite white (an output filter, averaging, vibration, a coarse grid) fits that
/// model best with R = 0 and delta2 near delta1: then x is the noise, filtered by phi, and a filter
/// with these parameters believes all of it. So where R holds less than half of the white noise
/// that the Allan variance shows, means over `cluster` samples are fitted, of which the noise is
/// white, by a random walk in white noise. R is that of white noise of the same density, and phi
/// and delta2 are held at 0 with infinite standard errors.
///
/// Of more than 2^20 samples a memory (phi, delta2) is told by the 2^18 in the middle alone, of
/// which the fit then says it is; else a walk in white noise is fitted to at most 2^18 means.
///
/// Example: R of a sensor with an output filter.
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 0}, series);
///   const ArimaFit fit = fit_random_error(series.gyro_dps, FitMethod::likelihood);
///   if (fit.cluster > 1) std::puts("the noise is coloured");
///
/// Thread safety: may run in any number of threads at once; it starts none.
ArimaFit fit_random_error(std::span<const double> rate_dps, FitMethod method);

}  // namespace gyrostat
