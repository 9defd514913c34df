#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// The headings of so many seconds before, `delay_s(i)` at sample i, each along the shorter arc
/// between its neighbours; before the first and after the last sample theirs. The times asked for
/// do not fall.
template <class Delay>
void delay_heading(const std::vector<double>& t_s, const Delay& delay_s,
                   std::vector<double>& heading_deg) {
  const std::size_t n = std::min(t_s.size(), heading_deg.size());
  if (n < 2) return;
  const auto before_deg = heading_deg;
  for (std::size_t i = 0, from = 0; i < n; ++i) {
    const double then_s = std::clamp(t_s[i] - delay_s(i), t_s[0], t_s[n - 1]);
    while (from + 2 < n && t_s[from + 1] <= then_s) ++from;
    const double share = (then_s - t_s[from]) / (t_s[from + 1] - t_s[from]);
    heading_deg[i] =
        before_deg[from] + share * wrap_degrees(before_deg[from + 1] - before_deg[from]);
  }
}

}  // namespace gyrostat
