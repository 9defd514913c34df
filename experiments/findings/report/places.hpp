#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gyrostat {

/// Places in a signal, for a picture: all of a short one, `most` evenly spaced of a long one, its
/// first and last among them.
inline std::vector<std::size_t> places(std::size_t samples, std::size_t most) {
  const std::size_t points = std::min(most, samples);
  std::vector<std::size_t> at(points);
  for (std::size_t k = 0; k < points; ++k)
    at[k] = points == 1 ? 0 : k * (samples - 1) / (points - 1);
  return at;
}

}  // namespace gyrostat
