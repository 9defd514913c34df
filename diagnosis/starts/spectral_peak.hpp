#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/analysis/spectra/welch.hpp>

namespace gyrostat::gap {

/// The frequency with the largest peak over its surroundings, and the power above them.
struct SpectralPeak {
  double frequency_hz = 0.0, power = 0.0, width_hz = 0.0, excess = 0.0;
  double floor = 0.0;  ///< density of the surroundings
};

/// Of peaks of at most `widest` bins to either side.
SpectralPeak highest_peak(const Spectrum& spectrum, std::size_t widest = 64);

/// Frequency of the highest line in the periodogram of `white`, to a quarter of what its length
/// resolves; 0 where that is too short.
double clearest_line_hz(const std::vector<double>& white, double interval_s);

}  // namespace gyrostat::gap
