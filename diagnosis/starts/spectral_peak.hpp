#pragma once

#include <gyrostat/analysis/spectra/welch.hpp>

namespace gyrostat::gap {

/// The frequency with the largest peak over its surroundings, and the power above them.
struct SpectralPeak {
  double frequency_hz = 0.0, power = 0.0, width_hz = 0.0, excess = 0.0;
  double floor = 0.0;  ///< density of the surroundings
};

SpectralPeak highest_peak(const Spectrum& spectrum);

}  // namespace gyrostat::gap
