#pragma once

#include <cstdint>
#include <vector>

#include <gyrostat/experiments/findings/report/cell_values.hpp>
#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// What trials of a cell look like over time: the first few, simulated again.
struct Replayed {
  struct Method {
    // By time. The error is estimate minus drift and random error, or where the truth is unknown
    // the innovation; the filter states the variance of either. Means over trials.
    std::vector<double> error_mean, error_std, stated_std;  ///< dps
    std::vector<double> heading_rms;                        ///< deg
    // By tau, of the compensated rate; mean over trials of the Allan variance and its standard
    // error.
    std::vector<double> allan_variance, allan_error;  ///< dps^2
    std::vector<double> judged;  ///< the judging metric, by trial; no value where it threw
  };
  std::uint32_t trials = 0;
  bool truth = false;
  std::vector<double> t_s{}, tau_s{};
  std::vector<Method> methods{};
};

/// So many trials that all samples of all methods number about 10^7: 2 to 64.
std::uint32_t trials_to_replay(const Cell& cell);

/// Trials 0 to `trials` - 1 of a cell; the same numbers for any number of threads. Where a method
/// throws in a trial, that trial counts for the others alone.
Replayed replay_trials(const PreparedCell& prepared, std::uint64_t seed, std::uint32_t trials);

/// Of outcomes that are both in the store and simulated again, one a method and trial.
struct Comparison {
  std::size_t compared = 0, different = 0;
};
Comparison compare(const Replayed& replayed, const CellValues& stored);

}  // namespace gyrostat
