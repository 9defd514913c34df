#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// How many samples had an innovation: the degrees of freedom of the sum that NIS is the mean of.
struct Innovations {
  static constexpr std::string_view title = "innovations";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const {
    return static_cast<double>(errors.innovations.count);
  }
};

}  // namespace gyrostat::metrics
