#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// What came out at the points of a design: one number a point and trial, NaN where there is none.
/// Trials of the same number share their random numbers over all points, so that their noise is
/// correlated.
class Outputs {
 public:
  Outputs(std::size_t points, std::size_t trials)
      : points_(points), trials_(trials), values_(points * trials, no_value) {}

  std::size_t points() const { return points_; }
  std::size_t trials() const { return trials_; }
  double& at(std::size_t point, std::size_t trial) { return values_[point * trials_ + trial]; }
  double at(std::size_t point, std::size_t trial) const { return values_[point * trials_ + trial]; }

 private:
  std::size_t points_, trials_;
  std::vector<double> values_;
};

}  // namespace gyrostat
