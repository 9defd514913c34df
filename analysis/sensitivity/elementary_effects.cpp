#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/analysis/sensitivity/estimators.hpp>
#include <gyrostat/analysis/sensitivity/paired_trials.hpp>
#include <gyrostat/analysis/sensitivity/trial_moments.hpp>

namespace gyrostat {
namespace {

/// One step of a trajectory, by trial; empty where too few trials have both of its ends.
using Effect = std::vector<double>;

/// The steps in each parameter.
std::vector<std::vector<Effect>> effects_of(const Points& points, const Outputs& outputs,
                                            double step) {
  const std::size_t parameters = points.front().size();
  std::vector<std::vector<Effect>> effects(parameters);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (i % (parameters + 1) == 0) continue;  // where the next trajectory starts
    std::size_t p = 0;
    while (points[i][p] == points[i - 1][p]) ++p;
    auto& effect = effects[p].emplace_back();
    if (!are_enough(common_trials(outputs, {i - 1, i}), outputs)) continue;
    const double sign = points[i][p] > points[i - 1][p] ? 1.0 : -1.0;
    for (std::size_t t = 0; t < outputs.trials(); ++t)
      effect.push_back(sign * (outputs.at(i, t) - outputs.at(i - 1, t)) / step);
  }
  return effects;
}

/// In each trial, the mean over those steps that have it.
std::vector<double> trial_levels(const std::vector<Effect>& effects, std::size_t trials) {
  std::vector<double> levels(trials);
  for (std::size_t t = 0; t < trials; ++t) {
    double sum = 0.0, count = 0.0;
    for (const auto& effect : effects)
      if (!effect.empty() && !std::isnan(effect[t])) {
        sum += effect[t];
        count += 1.0;
      }
    levels[t] = sum / count;
  }
  return levels;
}

/// mu*. What is taken out for the noise may be too little by 1.4 of it, where effects are zero, or
/// too much by less; the interval is widened by that.
Estimate mean_size(const std::vector<Effect>& effects, std::size_t trials, Resampler& resampler) {
  CrossedRows sizes(1, trials);
  double excess = 0.0;
  for (const auto& effect : effects) {
    if (effect.empty()) continue;
    const auto means = trial_means(effect);
    std::vector<std::vector<double>> size;
    for (const auto& mean : means) size.push_back({mean.magnitude()});
    sizes.add(size);
    excess += means.front().excess();
  }
  auto estimate = bootstrapped(
      sizes, [](auto m) { return m[0]; }, resampler);
  constexpr double doubt = 1.5;
  excess /= static_cast<double>(sizes.rows());
  estimate.low -= doubt * excess;
  estimate.high += doubt * excess;
  return estimate;
}

/// sigma, by the interval of its square: where noise hides it that may end below zero, and sigma at
/// zero.
Estimate spread_of(const std::vector<Effect>& effects, std::size_t trials, Resampler& resampler) {
  const auto levels = trial_levels(effects, trials);
  CrossedRows squares(2, trials);
  for (auto effect : effects) {
    if (effect.empty()) continue;
    for (std::size_t t = 0; t < trials; ++t) effect[t] -= levels[t];
    std::vector<std::vector<double>> square;
    for (const auto& mean : trial_means(effect)) square.push_back({mean.square(), mean.mean});
    squares.add(square);
  }
  const auto n = static_cast<double>(squares.rows());
  auto estimate = bootstrapped(
      squares, [&](auto m) { return (m[0] - m[1] * m[1]) * n / (n - 1.0); }, resampler);
  for (double* value : {&estimate.value, &estimate.low, &estimate.high})
    if (!std::isnan(*value)) *value = std::sqrt(std::max(0.0, *value));
  return estimate;
}

}  // namespace

std::vector<ElementaryEffect> elementary_effects(const Points& points, const Outputs& outputs,
                                                 double step, Resampler& resampler) {
  std::vector<ElementaryEffect> all;
  for (const auto& effects : effects_of(points, outputs, step))
    all.push_back({.parameter = "",
                   .mu_star = mean_size(effects, outputs.trials(), resampler),
                   .sigma = spread_of(effects, outputs.trials(), resampler),
                   .left_out = static_cast<std::size_t>(std::count_if(
                       effects.begin(), effects.end(), [](const auto& e) { return e.empty(); }))});
  return all;
}

double elementary_noise(const Points& points, const Outputs& outputs, double step) {
  double sum = 0.0, count = 0.0;
  for (const auto& effects : effects_of(points, outputs, step))
    for (const auto& effect : effects)
      if (!effect.empty()) {
        sum += std::sqrt(trial_means(effect).front().variance);
        count += 1.0;
      }
  return std::sqrt(2.0 / std::numbers::pi) * sum / count;
}

}  // namespace gyrostat
