#pragma once

#include <cmath>
#include <numbers>

namespace gyrostat {

/// What is left of a number of turns, from -1/2 to 1/2; exact below 2^51 turns.
inline double within_a_turn(double turns) {
  constexpr double drops_fractions = 0x1.8p52;
  return turns - ((turns + drops_fractions) - drops_fractions);
}

/// 1 - z / (2 3) (1 - z / (4 5) (1 - ...)): Taylor's series of sin x over x, in z = x^2, to x^21.
template <int pair = 1>
double sine_series(double z) {
  if constexpr (pair > 10)
    return 1.0;
  else
    return 1.0 - z * (1.0 / (2 * pair * (2 * pair + 1))) * sine_series<pair + 1>(z);
}

/// sin(2 pi turns), within 3e-16 of it where the turns are below 2^51: additions and
/// multiplications alone, which a compiler puts side by side and every processor rounds alike.
inline double sine_of_turns(double turns) {
  const double rest = within_a_turn(turns);
  const double quarter = std::copysign(0.25 - std::abs(std::abs(rest) - 0.25), rest);
  const double x = 2.0 * std::numbers::pi * quarter;
  return x * sine_series(x * x);
}

}  // namespace gyrostat
