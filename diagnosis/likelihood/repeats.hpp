#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/likelihood/slower_clock.hpp>

namespace gyrostat::gap {

/// The least and the largest value of a recording's train part.
struct Ends {
  double low, high;
  bool holds(double value) const { return value == low || value == high; }
};

/// Which of the values repeat the one before, or one that is a few samples older, beyond what
/// chance and the grid do: beside the marks of grid, limits and silence. Without such values
/// nothing is changed. Where there is a slower clock, it says which.
void read_repeats(const Simulator& simulator, const std::vector<double>& values, const Ends& ends,
                  const std::optional<SlowerClock>& clock, Marks& marks);

}  // namespace gyrostat::gap
