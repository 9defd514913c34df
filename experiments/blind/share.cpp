#include <gyrostat/experiments/blind/share.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {

TableCell Share::percent() const { return cell(count > 0 ? 100.0 * hits / count : no_value); }

TableCell Share::bound(bool upper) const {
  if (count == 0) return {};
  const auto [low, high] = wilson_interval(hits, count, 0.95);
  return 100.0 * (upper ? high : low);
}

TableCell Share::text() const {
  if (count == 0) return {};
  const auto [low, high] = wilson_interval(hits, count, 0.95);
  return fmt::format("{:.0f} % ({:.0f} of {:.0f}; {:.0f} to {:.0f})", 100.0 * hits / count, hits,
                     count, 100.0 * low, 100.0 * high);
}

TableCell Share::plain() const {
  return count == 0 ? TableCell() : fmt::format("{:.0f} of {:.0f}", hits, count);
}

TableCell bootstrapped(std::size_t recordings,
                       const std::function<double(std::span<const std::size_t>)>& statistic) {
  constexpr std::uint32_t resamples = 1000;
  std::vector<std::size_t> drawn(recordings);
  std::iota(drawn.begin(), drawn.end(), std::size_t{0});
  if (recordings == 0) return {};
  const double value = statistic(drawn);
  if (std::isnan(value)) return {};
  std::vector<double> others;
  for (std::uint32_t b = 0; b < resamples; ++b) {
    const NormalStream stream(1, b, "blind_check/bootstrap");
    for (std::size_t k = 0; k < recordings; ++k)
      drawn[k] =
          std::min(recordings - 1,
                   static_cast<std::size_t>(stream.uniform(k) * static_cast<double>(recordings)));
    const double other = statistic(drawn);
    if (!std::isnan(other)) others.push_back(other);
  }
  std::sort(others.begin(), others.end());
  const auto at = [&](double share) {
    return others[static_cast<std::size_t>(share * static_cast<double>(others.size() - 1))];
  };
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", value, at(0.025), at(0.975));
}

TableCell bootstrapped_median(const std::vector<double>& values) {
  return bootstrapped(values.size(), [&](std::span<const std::size_t> drawn) {
    std::vector<double> some;
    for (const auto k : drawn) some.push_back(values[k]);
    std::nth_element(some.begin(), some.begin() + some.size() / 2, some.end());
    return some[some.size() / 2];
  });
}

}  // namespace gyrostat::gap
