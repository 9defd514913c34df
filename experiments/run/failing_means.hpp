#pragma once

#include <optional>
#include <vector>

#include <gyrostat/experiments/run/failure_run.hpp>

namespace gyrostat {

/// What the trials of a search that fail have on the average, run by run: failing trials of one run
/// descend from few, and only what independent runs have in common counts.
struct FailingMeans {
  std::vector<NoiseTape> of_runs;  ///< mean deviates of each run's failing trials to the same side
  std::vector<NoiseShare> shares;  ///< of the trials whose deviates make the mean over the runs
  double same_side = 1.0;          ///< share of the failing trials that fail to that side
};

/// Of a search that reached its threshold, in a cell with its method alone; nothing where fewer
/// than two runs fail to the same side. A metric that is bad to both sides has a failure on each:
/// the side is the one to which more trials fail, told by the sign of the heading error farthest
/// from zero, or else of the mean rate or bias error. `store` is that of failures, `index` the
/// cell's place in it.
std::optional<FailingMeans> failing_means(const PreparedCell& prepared, const FailureRule& rule,
                                          const FailureSearch& search, const Store& store,
                                          std::uint32_t index, std::uint64_t seed);

}  // namespace gyrostat
