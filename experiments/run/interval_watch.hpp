#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// Follows the 95 % intervals of a cell's means while trials come in, in whatever order: for people
/// who watch. The tables have the exact ones.
class IntervalWatch {
 public:
  explicit IntervalWatch(const Cell& cell);

  /// Outcomes of one trial, as the store has them.
  void add(std::span<const double> outcomes);

  struct Widest {
    std::string method;
    double half_width = no_value;  ///< in the unit of the judging metric
  };
  Widest widest() const;

 private:
  std::vector<std::string> methods_;
  std::size_t metric_;
  std::vector<Running> means_;
};

}  // namespace gyrostat
