#pragma once

#include <span>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Moments of the differences of neighbouring cluster means at one cluster length.
struct Octave {
  std::size_t cluster = 1;
  std::size_t count = 0;        ///< of differences
  double mean_square = 0.0;     ///< of a difference: twice the Allan variance
  double kurtosis = 3.0;        ///< of the differences about zero
  double peak = 1.0;            ///< largest square over the mean square
  double level_kurtosis = 3.0;  ///< of the cluster means about the mean of their span
};

/// Octaves 1, 2, 4, ... while `fewest` differences can be had in all spans; NaN values are passed
/// over pair by pair.
std::vector<Octave> octaves(const std::vector<double>& values, std::span<const Span> spans,
                            std::size_t fewest = 8);
/// How many octaves there are, whatever the values.
std::size_t octave_count(std::span<const Span> spans, std::size_t fewest = 8);

}  // namespace gyrostat::gap
