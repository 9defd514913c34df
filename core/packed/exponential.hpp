#pragma once

#include <bit>
#include <cstdint>

#include <gyrostat/core/packed/pack.hpp>

namespace gyrostat {

/// exp(x), lane by lane, where no x is above 0, within three units in the last place; below -700,
/// exp(-700). x = n log 2 + r with log 2 in two parts (Cody and Waite, "Software Manual for the
/// Elementary Functions", 1980), and of r, within half of log 2, the series up to its twelfth
/// power. Additions and multiplications in a fixed order, so every target gives the same bits.
template <class Target, int N>
[[gnu::always_inline]] inline Pack<Target, N> exp_of_negative(const Pack<Target, N>& of) {
  alignas(64) double x[N];
  of.store(x);
  constexpr double to_integer = 0x1.8p52;  // added, it leaves the nearest integer in the last bits
  constexpr auto one = std::bit_cast<std::uint64_t>(1.0);
  for (int lane = 0; lane < N; ++lane) {
    const double y = x[lane] < -700.0 ? -700.0 : x[lane];
    const double shifted = y * 1.44269504088896338700 + to_integer, n = shifted - to_integer;
    const double r = (y - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
    const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const double series =
        ((1.0 + r) + r2 * (1.0 / 2 + r * (1.0 / 6))) +
        r4 * ((1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040))) +
        r8 * ((1.0 / 40320 + r * (1.0 / 362880)) + r2 * (1.0 / 3628800 + r * (1.0 / 39916800)) +
              r4 * (1.0 / 479001600));
    x[lane] = series * std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) << 52U) + one);
  }
  return Pack<Target, N>::load(x);
}

}  // namespace gyrostat
