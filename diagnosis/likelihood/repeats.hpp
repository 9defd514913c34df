#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/marks.hpp>

namespace gyrostat::gap {

/// The least and the largest value of a recording's train part.
struct Ends {
  double low, high;
  bool holds(double value) const { return value == low || value == high; }
};

/// Which of the values repeat the one before, or one that is a few samples older, beyond what chance
/// and the grid do: beside the marks of grid, limits and silence. Without such values nothing is changed.
void read_repeats(const Simulator& simulator, const std::vector<double>& values, const Ends& ends,
                  Marks& marks);

}  // namespace gyrostat::gap
