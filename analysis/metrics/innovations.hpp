#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// How many samples had an innovation: the degrees of freedom of the sum that NIS is the mean of.
struct Innovations {
  static constexpr std::string_view title = "innovations";
  static constexpr std::string_view unit = "1";

  double operator()(const TrackErrors& errors) const {
    return static_cast<double>(errors.innovations.count);
  }
};

}  // namespace gyrostat::metrics
