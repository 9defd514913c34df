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

}  // namespace gyrostat
