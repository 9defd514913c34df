#pragma once

#include <cstddef>
#include <vector>

namespace gyrostat {

/// Systematic resampling (Kitagawa 1996): index i goes to floor or ceil of N weights[i] of the N
/// places, by one uniform deviate on (0, 1). The weights sum to 1.
template <class T>
std::vector<std::size_t> systematic_resampling(const std::vector<T>& weights, const T& uniform) {
  const std::size_t n = weights.size();
  std::vector<std::size_t> chosen(n);
  std::size_t i = 0;
  T below = weights.front();
  for (std::size_t place = 0; place < n; ++place) {
    const T at = (T(static_cast<double>(place)) + uniform) / T(static_cast<double>(n));
    while (at > below && i + 1 < n) below += weights[++i];
    chosen[place] = i;
  }
  return chosen;
}

}  // namespace gyrostat
