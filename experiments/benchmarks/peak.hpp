#pragma once

#include <cstddef>

#include <gyrostat/core/packed/pack.hpp>

namespace gyrostat {

inline constexpr int peak_chains = 12;

/// Multiplications and additions that a round of `multiply_add_peak<Target>` makes.
template <class Target>
inline constexpr std::size_t operations_per_round = 2 * peak_chains* Target::width;

/// Independent chains of x <- x m + s, rounded after each operation as all kernels here are: as
/// many operations as the core can do in registers of `Target`. Twelve chains, since a
/// multiplication and an addition take six cycles and two of each can start in one.
template <class Target>
[[gnu::flatten]] double multiply_add_peak(std::size_t rounds, double m, double s) {
  using P = Pack<Target, Target::width>;
  P x[peak_chains];
  unrolled<peak_chains>([&]<int i>() { x[i] = P(1.0 + i); });
  const P factor(m), summand(s);
  for (std::size_t r = 0; r < rounds; ++r)
    unrolled<peak_chains>([&]<int i>() { x[i] = x[i] * factor + summand; });
  P sum(0.0);
  unrolled<peak_chains>([&]<int i>() { sum += x[i]; });
  return sum[0];
}

}  // namespace gyrostat
