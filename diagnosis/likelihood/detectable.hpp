#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

/// An effect of the size at which the search finds it in a share `power` of recordings of this
/// length, sampling and noise, beside the set that it stands with.
struct Detectable {
  static constexpr double power = 0.8;

  Effect effect;      ///< of that size; its other parameters are an example
  std::size_t field;  ///< which of its parameters the size is
};

/// Of every assessable effect on the rate that the set has not and that has a size: one that is
/// absent at zero. What is found by single values (a grid, repeats, outliers) and what has no size
/// (a cutoff, a length) is left out, as are effects on the compass.
///
/// The search takes an effect in where it gains more than its price (SetBench::fitted, and
/// `least_gain` of the effect). By a large recording an effect of size s gains half the square of a
/// normal deviate about s over its standard error, which is that of intervals: so the size asked
/// for is the standard error times √(2 price) + 0.84 (Kay, "Fundamentals of Statistical Signal
/// Processing: Detection Theory", 1998, 6.5). What a random effect gains is a matter of its law
/// (gain_over).
std::vector<Detectable> detectable_beside(
    const SetBench& bench, const Standing& standing,
    const std::function<double(std::string_view)>& least_gain);

}  // namespace gyrostat::gap
