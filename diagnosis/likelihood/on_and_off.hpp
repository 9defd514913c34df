#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/two_exponentials.hpp>

namespace gyrostat::gap {

/// What is on or off, block after block, as a Markov chain: the value of a block is exponential
/// about one of two means.
struct OnAndOff {
  double on = 0.0, off = 0.0;       ///< means
  double begins = 0.5, ends = 0.5;  ///< chance that on follows off, and off on
  double weight = 1.0;  ///< of a value: neighbours that are alike say less than one each

  static OnAndOff in_any_order(const TwoExponentials& means, double weight);

  /// Chance that each block is on, from all values of its stretch; what is missing says nothing.
  std::vector<double> chance_of_on(const std::vector<double>& values) const;
};

/// Of stretches, from a start, by expectation-maximisation (Rabiner, "A tutorial on hidden Markov
/// models", Proc. IEEE 77, 1989, III.C).
OnAndOff on_and_off(const std::vector<std::vector<double>>& stretches, OnAndOff start);

}  // namespace gyrostat::gap
