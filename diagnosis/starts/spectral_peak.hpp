#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/analysis/spectra/welch.hpp>
#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// The frequency with the largest peak over its surroundings, and the power above them.
struct SpectralPeak {
  double frequency_hz = 0.0, power = 0.0, width_hz = 0.0, excess = 0.0;
  double floor = 0.0;  ///< density of the surroundings
};

/// Of peaks of at most `widest` bins to either side.
SpectralPeak highest_peak(const Spectrum& spectrum, std::size_t widest = 64);

/// The train part of `values` (NaN: missing) without the mean of each span; 0 elsewhere.
std::vector<double> train_about_means(const Conditions& conditions,
                                      const std::vector<double>& values);

/// Squares of the discrete Fourier transform of `values`, from bin `first` to before bin `last`.
std::vector<double> powers_of(const std::vector<double>& values, std::size_t first,
                              std::size_t last);

/// Frequency of the highest line in the periodogram of `values`, to half of what their length
/// resolves, over the median of as many resolved frequencies `around` it (0: over all alike), above
/// `lowest_hz`; 0 where they are too few.
double clearest_line_hz(const std::vector<double>& values, double interval_s,
                        std::size_t around = 0, double lowest_hz = 0.0);

}  // namespace gyrostat::gap
