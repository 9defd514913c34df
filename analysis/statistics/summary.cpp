#include <gyrostat/analysis/statistics/summary.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/skewed_mean.hpp>

namespace gyrostat {
namespace {

/// Linear interpolation between order statistics (Hyndman and Fan 1996, type 7).
double quantile(std::span<const double> sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

}  // namespace

double half_width_95(const Running& values) {
  if (values.count < 2.0) return no_value;
  const auto [below, above] = skewed_mean_reach(values, 0.025);
  return std::max(below, above);
}

Summary summarise(std::span<const double> values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present),
               [](double v) { return !std::isnan(v); });
  Summary summary{.count = present.size(), .missing = values.size() - present.size()};
  if (present.empty()) return summary;

  const double n = static_cast<double>(present.size());
  double sum = 0.0;
  for (const double v : present) sum += v;
  summary.mean = sum / n;
  Running about_mean{.count = n, .mean = summary.mean};
  for (const double v : present) {
    const double d = v - summary.mean;
    about_mean.squares += d * d;
    about_mean.cubes += d * d * d;
  }
  summary.std = about_mean.std();
  summary.half_width_95 = half_width_95(about_mean);
  std::sort(present.begin(), present.end());
  summary.median = quantile(present, 0.5);
  for (double& v : present) v = std::abs(v);
  std::sort(present.begin(), present.end());
  summary.percentile_95 = quantile(present, 0.95);
  summary.worst = present.back();
  return summary;
}

}  // namespace gyrostat
