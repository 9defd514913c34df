#pragma once

#include <cmath>
#include <initializer_list>
#include <vector>

#include <gyrostat/analysis/sensitivity/outputs.hpp>

namespace gyrostat {

/// Trials that all of `points` have.
inline std::vector<std::size_t> common_trials(const Outputs& outputs,
                                              std::initializer_list<std::size_t> points) {
  std::vector<std::size_t> common;
  for (std::size_t t = 0; t < outputs.trials(); ++t) {
    bool everywhere = true;
    for (const auto point : points) everywhere = everywhere && !std::isnan(outputs.at(point, t));
    if (everywhere) common.push_back(t);
  }
  return common;
}

/// Whether they tell the noise as well as the mean; of a study of single trials nothing does.
inline bool are_enough(const std::vector<std::size_t>& common, const Outputs& outputs) {
  return common.size() >= std::min<std::size_t>(2, outputs.trials()) && !common.empty();
}

/// In each trial, the mean over those points that have it.
inline std::vector<double> trial_levels(const Outputs& outputs) {
  std::vector<double> levels(outputs.trials());
  for (std::size_t t = 0; t < levels.size(); ++t) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < outputs.points(); ++i)
      if (!std::isnan(outputs.at(i, t))) {
        sum += outputs.at(i, t);
        count += 1.0;
      }
    levels[t] = sum / count;
  }
  return levels;
}

}  // namespace gyrostat
