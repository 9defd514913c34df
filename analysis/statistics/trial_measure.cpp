#include <gyrostat/analysis/statistics/trial_measure.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/analysis/statistics/skewed_mean.hpp>
#include <gyrostat/analysis/statistics/tail_mean.hpp>
#include <gyrostat/core/fields.hpp>

namespace gyrostat {
namespace {

/// Between the two order statistics that the 95 % quantile lies between.
double tail_quantile(std::span<const double> errors) {
  std::vector<double> sorted;
  for (const double error : errors)
    if (!std::isnan(error)) sorted.push_back(error);
  if (sorted.empty()) return no_value;
  std::sort(sorted.begin(), sorted.end());
  const double at = (1.0 - tail_share) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

}  // namespace

std::string TrialMeasure::title() const {
  if (kind == Kind::mean) return "mean";
  if (kind == Kind::cvar95) return "mean of the worst 5 %";
  return "probability above " + short_number(limit);
}

std::vector<double> TrialMeasure::scores(std::span<const double> errors) const {
  std::vector<double> scores(errors.begin(), errors.end());
  if (kind == Kind::probability)
    for (double& x : scores) x = std::isnan(x) || x > limit;
  if (kind == Kind::cvar95) {
    const double v = tail_quantile(errors);
    for (double& x : scores)
      if (!std::isnan(x)) x = v + std::max(0.0, x - v) / tail_share;
  }
  return scores;
}

TrialMeasure::Value TrialMeasure::of(std::span<const double> errors) const {
  Running sums;
  for (const double score : scores(errors)) sums.add(score);
  Value found{.trials = errors.size()};
  found.missing = static_cast<std::size_t>(
      std::count_if(errors.begin(), errors.end(), [](double x) { return std::isnan(x); }));
  if (sums.count < 1.0) return found;
  found.value = sums.mean;
  if (kind == Kind::probability)  // a number of trials, whatever their mean was rounded to
    std::tie(found.low, found.high) =
        wilson_interval(std::round(sums.mean * sums.count), sums.count, 0.95);
  if (kind != Kind::probability && sums.count >= 2.0 &&
      (kind == Kind::mean || sums.count >= fewest_for_tail_interval))
    std::tie(found.low, found.high) = skewed_mean_interval(sums, 0.025);
  return found;
}

double TrialMeasure::objective(std::span<const double> errors) const {
  const auto found = of(errors);
  if (kind != Kind::probability) return found.missing > 0 ? no_value : found.value;
  Running sums;
  for (const double error : errors) sums.add(error);
  const double size = std::abs(sums.mean) + limit;
  const double below_a_trial = 0.25 / static_cast<double>(errors.size());
  return found.value + (size > 0.0 ? below_a_trial * sums.mean / size : 0.0);
}

}  // namespace gyrostat
