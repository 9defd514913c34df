#include <gyrostat/diagnosis/likelihood/equal_by_chance.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// Of those that are there and not 0.
std::vector<double> sizes_of(const std::vector<double>& differences) {
  std::vector<double> sizes;
  for (const double d : differences)
    if (d != 0.0 && !is_missing(d)) sizes.push_back(std::abs(d));
  return sizes;
}

}  // namespace

double equal_by_chance(const std::vector<double>& differences, double step) {
  const auto sizes = sizes_of(differences);
  constexpr double level_within = 0.3;  // of the median
  if (const double reach = std::floor(level_within * quantile(sizes, 0.5) / step); reach >= 2.0) {
    const auto within = std::count_if(sizes.begin(), sizes.end(), [&](double size) {
      return std::nearbyint(size / step) <= reach;
    });
    return static_cast<double>(within) / (2.0 * reach);
  }
  double ones = 0.0, twos = 0.0, threes = 0.0;
  for (const double d : differences) {
    const double steps = std::abs(d) / step;
    ones += std::abs(steps - 1.0) < 0.3 ? 0.5 : 0.0;
    twos += std::abs(steps - 2.0) < 0.3 ? 0.5 : 0.0;
    threes += std::abs(steps - 3.0) < 0.3 ? 0.5 : 0.0;
  }
  // On a coarser grid it matters where between two of its values the level is.
  if (twos < 50.0 || twos < 0.2 * ones) return -1.0;
  // Nor are they normal where many more differ by three.
  constexpr double many_more = 1.25, clear = 6.0;  // standard deviations
  if (const double normal = twos * std::pow(twos / ones, 5.0 / 3.0);
      threes > many_more * normal + clear * std::sqrt(normal + 1.0))
    return -1.0;
  return ones * std::pow(std::max(ones / twos, 1.0), 1.0 / 3.0);
}

double step_of_moved_grid(const std::vector<double>& differences) {
  constexpr double hardly = 0.01, most_of_them = 0.95, ends = 0.005;
  constexpr double least_steps = 0.2;  // where the noise is not far below a step
  auto sizes = sizes_of(differences);
  std::sort(sizes.begin(), sizes.end());
  const auto few = static_cast<std::size_t>(ends * static_cast<double>(sizes.size()));
  double widest = 1.0 / hardly, step = 0.0;
  for (std::size_t i = few + 1; i + few < sizes.size(); ++i)
    if (const double ratio = sizes[i] / sizes[i - 1]; ratio > widest) {
      widest = ratio;
      step = sizes[i];
    }
  const auto steps =
      std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > 0.5 * step; });
  if (step == 0.0 || static_cast<double>(steps) < least_steps * static_cast<double>(sizes.size()))
    return 0.0;
  const auto whole = std::count_if(sizes.begin(), sizes.end(), [&](double size) {
    return std::abs(size / step - std::nearbyint(size / step)) < hardly;
  });
  return static_cast<double>(whole) > most_of_them * static_cast<double>(sizes.size()) ? step : 0.0;
}

}  // namespace gyrostat::gap
