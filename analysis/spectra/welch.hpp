#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrostat {

/// A one-sided power spectral density; bin k stands at k times `resolution_hz`.
struct Spectrum {
  double resolution_hz = 0.0;
  std::vector<double> density;  ///< unit^2 / Hz; empty where no stretch was long enough
  std::size_t segments = 0;
};

/// Averages the Hann-windowed, mean-free periodograms of segments of `length` samples, each `hop`
/// after the one before, over every stretch of evenly sampled values (Welch, IEEE Trans. Audio
/// Electroacoust. AU-15, 1967). `length` is a power of two >= 4; stretches shorter than it are
/// passed over.
Spectrum welch(std::span<const std::span<const double>> stretches, double rate_hz,
               std::size_t length, std::size_t hop);

}  // namespace gyrostat
