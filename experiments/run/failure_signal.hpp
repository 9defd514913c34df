#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/experiments/run/failure_run.hpp>

namespace gyrostat {

/// How a method fails: the deviates that failing trials have in common. Of a failure that one
/// direction of the deviates leads to, their mean is its design point, the failing deviates nearest
/// to none at all, which are the most likely ones (Hasofer and Lind, J. Eng. Mech. Div. 100, 1974).
struct FailureSignal {
  /// Of the trials whose deviates make it, scaled so that the metric is at its threshold; deviates
  /// that failing trials do not have in common are all but zero.
  std::vector<NoiseShare> shares;
  double metric = 0.0;     ///< of that signal
  double distance = 0.0;   ///< of the design point from no deviates at all
  double same_side = 1.0;  ///< share of the failing trials that fail to the same side as it
  std::map<std::string, double> drivers;  ///< share of each stream of deviates in distance squared
};

/// Of a search that reached its threshold, in a cell with its method alone. Nothing where runs have
/// no failing deviates in common, or their mean does not fail at any scale.
///
/// Failing trials of one run descend from few, so only what independent runs have in common counts:
/// the squared length of a stream's mean is the mean product of two runs' means, which noise does
/// not bias. A metric that is bad to both sides has a failure on each; the signal is of the one
/// to which more trials fail, told by the sign of the heading error farthest from zero, or else of
/// the mean rate or bias error. `store` is that of failures, `index` the cell's place in it.
std::optional<FailureSignal> failure_signal(const PreparedCell& prepared, const FailureRule& rule,
                                            const FailureSearch& search, const Store& store,
                                            std::uint32_t index, std::uint64_t seed);

}  // namespace gyrostat
