#pragma once

#include <span>

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap {

/// Logarithmic bands of bins [first, last) of a spectrum.
struct Bands {
  std::vector<Span> bins;

  Bands() = default;
  /// About `per_octave` bands an octave from bin 2 to the last, each of at least `fewest` bins.
  Bands(std::size_t size, double per_octave, std::size_t fewest) {
    double edge = 2.0;
    std::size_t first = 2;
    while (first + fewest <= size) {
      edge = std::max(edge * std::exp2(1.0 / per_octave), static_cast<double>(first + fewest));
      const std::size_t last = std::min(static_cast<std::size_t>(edge), size);
      if (size - last < fewest) {
        bins.push_back({first, size});
        return;
      }
      bins.push_back({first, last});
      first = last;
    }
  }
};

/// Length of the segments that Scene takes from `spans`; 0 where they are too short.
std::size_t segment_length(std::span<const Span> spans);
/// How many bins the spectrum of `spans` has.
inline std::size_t spectrum_size(std::span<const Span> spans) {
  const std::size_t length = segment_length(spans);
  return length == 0 ? 0 : length / 2 + 1;
}
inline double spectrum_resolution_hz(std::span<const Span> spans, double rate_hz) {
  return rate_hz / static_cast<double>(std::max<std::size_t>(1, segment_length(spans)));
}

}  // namespace gyrostat::gap
