#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace gyrostat {

/// `values` after `pass` has gone over them forward and then back, so that nothing is late. Up to
/// `beyond` places past either end they are turned about that end, where a filter comes to rest
/// (Gustafsson, IEEE Trans. Signal Processing 44, 1996, compares such ends).
template <class Pass>
std::vector<double> forward_and_back(std::span<const double> values, std::size_t beyond,
                                     const Pass& pass) {
  if (values.empty()) return {};
  const std::size_t n = values.size();
  beyond = std::min(beyond, n - 1);
  std::vector<double> all;
  all.reserve(n + 2 * beyond);
  for (std::size_t k = beyond; k > 0; --k) all.push_back(2.0 * values[0] - values[k]);
  all.insert(all.end(), values.begin(), values.end());
  for (std::size_t k = 1; k <= beyond; ++k) all.push_back(2.0 * values[n - 1] - values[n - 1 - k]);
  for (int way = 0; way < 2; ++way) {
    pass(all);
    std::reverse(all.begin(), all.end());
  }
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(beyond);
  return {first, first + static_cast<std::ptrdiff_t>(n)};
}

}  // namespace gyrostat
