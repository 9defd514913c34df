#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace gyrostat {

/// By how much a smooth signal is steeper at a sample than the secant of its two neighbours, by the
/// sample: a third of what that secant has beyond the one of twice the width (Richardson, Phil.
/// Trans. R. Soc. A 210, 1911). Slopes of a sine of a twentieth of the sampling rate are then right
/// to a part in three thousand, for one in sixty. 0 where the signal bends as no smooth one does:
/// at jumps and kinks and in noise its fourth difference is as large as the second ones about it;
/// and within two samples of an end of [first, last).
inline double beyond_secant(const std::vector<double>& values, std::size_t i, std::size_t first,
                            std::size_t last) {
  constexpr double smooth = 0.7;
  if (i < first + 2 || i + 2 >= last) return 0.0;
  const double *at = values.data() + i, before = at[-2] - 2.0 * at[-1] + at[0],
               here = at[-1] - 2.0 * at[0] + at[1], after = at[0] - 2.0 * at[1] + at[2];
  const double second = std::abs(before) + std::abs(here) + std::abs(after);
  if (!(std::abs(before - 2.0 * here + after) < smooth * second)) return 0.0;
  return (0.5 * (at[1] - at[-1]) - 0.25 * (at[2] - at[-2])) / 3.0;
}

}  // namespace gyrostat
