#include <gyrostat/diagnosis/likelihood/beside_jumps.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/foretold.hpp>

namespace gyrostat::gap {

std::vector<char> samples_beside_jumps(const std::vector<double>& left_dps,
                                       const std::vector<Span>& blocks) {
  std::vector<char> flags(left_dps.size(), 0);
  std::vector<double> present;
  for (const double v : left_dps)
    if (!is_missing(v)) present.push_back(v);
  if (present.empty()) return flags;
  // Cut, so that no single sample makes two levels.
  const double deviation = robust_deviation(std::move(present)), most = 3.0 * deviation;
  constexpr double clear = 25.0,
                   fewest = 4.0;  // of squares, in variances; of samples, on each side
  for (const auto& [first, last] : blocks) {
    double total = 0.0, all = 0.0;
    const auto value = [&](std::size_t i) { return std::clamp(left_dps[i], -most, most); };
    for (std::size_t i = first; i < last; ++i)
      if (!is_missing(left_dps[i])) total += value(i), all += 1.0;
    double sum = 0.0, count = 0.0, explained = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      if (is_missing(left_dps[i])) continue;
      sum += value(i);
      count += 1.0;
      if (count < fewest || all - count < fewest) continue;
      const double rest = all - count;
      const double apart = sum / count - (total - sum) / rest;
      explained = std::max(explained, apart * apart * count * rest / all);
    }
    if (explained > clear * deviation * deviation)
      std::fill(flags.begin() + static_cast<std::ptrdiff_t>(first),
                flags.begin() + static_cast<std::ptrdiff_t>(last), char{1});
  }
  return flags;
}

}  // namespace gyrostat::gap
