#pragma once

#include <cstddef>
#include <span>

namespace gyrostat {

/// How far one signal is a linear response to another at a frequency.
struct Coherence {
  double squared = 0.0;      ///< magnitude squared, 0 to 1; 0 where there are no segments
  std::size_t segments = 0;  ///< that it is an average over
};

/// Over the Hann-windowed, mean-free segments of `length` samples, side by side, in which neither
/// signal misses a sample (Carter, Knapp and Nuttall, IEEE Trans. Audio Electroacoust. AU-21,
/// 1973). The signals are equally long, and `cycles` is the frequency in cycles a sample.
Coherence coherence(std::span<const double> x, std::span<const double> y, double cycles,
                    std::size_t length);

/// How often so much coherence is chance where one of the signals is Gaussian noise: (1 - c)^(n -
/// 1) over n segments (the same paper).
double chance_of(const Coherence& coherence);

}  // namespace gyrostat
