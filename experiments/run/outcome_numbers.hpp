#pragma once

#include <vector>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/core/track.hpp>

namespace gyrostat {

/// A trial counts as diverged where its bias RMSE is above so many times that of no compensation.
inline constexpr double divergence_ratio = 3.0;

/// RMS of what there is to compensate, drift and random error, from a JudgeKernel's sums; NaN
/// without the truth.
double uncompensated_rmse(double count, double squares);
double uncompensated_rmse(const Series& series);

/// What a method made of a series, for metrics that need all of it.
struct Made {
  const Series* judged = nullptr;
  const Track* track = nullptr;
};

/// The numbers of an Outcome: every metric, how many steps went which way, and whether it diverged.
std::vector<double> numbers_of(const TrackErrors& errors, double uncompensated_dps, Made made);

}  // namespace gyrostat
