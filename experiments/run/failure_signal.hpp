#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/experiments/run/failing_means.hpp>

namespace gyrostat {

/// How a method fails: the deviates that failing trials have in common. Of a failure that one
/// direction of the deviates leads to, their mean is its design point, the failing deviates nearest
/// to none at all, which are the most likely ones (Hasofer and Lind, J. Eng. Mech. Div. 100, 1974).
struct FailureSignal {
  /// Of the trials whose deviates make it, scaled so that the metric is at its threshold; deviates
  /// that failing trials do not have in common are all but zero.
  std::vector<NoiseShare> shares;
  double metric = 0.0;                    ///< of that signal
  double distance = 0.0;                  ///< of the design point from no deviates at all
  double same_side = 1.0;                 ///< share of the failing trials that fail to its side
  std::map<std::string, double> drivers;  ///< share of each stream of deviates in distance squared
};

/// Of what failing trials have in common, in a cell with its method alone. Nothing where runs have
/// no failing deviates in common, or their mean does not fail at any scale. The squared length of a
/// stream's mean is the mean product of two runs' means, which noise does not bias.
std::optional<FailureSignal> failure_signal(const PreparedCell& prepared, const FailureRule& rule,
                                            const FailingMeans& means, std::uint64_t seed);

}  // namespace gyrostat
