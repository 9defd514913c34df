#include "analysis/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

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

double student_t_quantile(double confidence, double degrees_of_freedom) {
  const boost::math::students_t t(degrees_of_freedom);
  return boost::math::quantile(t, 0.5 + confidence / 2.0);
}

std::pair<double, double> spread(double squares, double n) {
  const double std = std::sqrt(squares / (n - 1.0));
  return {std, student_t_quantile(0.95, n - 1.0) * std / std::sqrt(n)};
}

Summary summarise(std::span<const double> values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present),
               [](double v) { return !std::isnan(v); });
  Summary summary{.count = present.size(), .missing = values.size() - present.size()};
  if (present.empty()) return summary;

  const double n = static_cast<double>(present.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : present) sum += v;
  summary.mean = sum / n;
  for (const double v : present) squares += (v - summary.mean) * (v - summary.mean);
  if (present.size() > 1) std::tie(summary.std, summary.half_width_95) = spread(squares, n);
  std::sort(present.begin(), present.end());
  summary.median = quantile(present, 0.5);
  for (double& v : present) v = std::abs(v);
  std::sort(present.begin(), present.end());
  summary.percentile_95 = quantile(present, 0.95);
  summary.worst = present.back();
  return summary;
}

}  // namespace gyrostat
