#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/metrics/list.hpp"
#include "core/track.hpp"
#include "experiments/study.hpp"

namespace gyrostat {

inline constexpr std::size_t metric_count = std::variant_size_v<Metrics::Any>;

/// What one method made of one trial.
struct Outcome {
  std::array<double, metric_count> metrics{};  ///< in the order of Metrics::ids(); NaN: no value
  std::array<std::uint32_t, status_names.size()> status_counts{};
  bool diverged = false;  ///< bias RMSE above `divergence_ratio` times that of no compensation
  std::string thrown;     ///< what the method threw; then there is nothing else

  std::uint32_t breakdowns() const;
};

inline constexpr double divergence_ratio = 3.0;

/// One trial: every method on the same signal.
struct Record {
  std::vector<Outcome> outcomes;  ///< one a method, in the cell's order
  bool calibration_converged = true;
};

/// Buffers that a thread reuses from trial to trial, and the time that each method took there.
struct Workspace {
  Series series;
  Series denoised;
  Series calibration_series;
  Track track;
  std::vector<double> seconds;  ///< one a method
  std::vector<double> steps;
};

/// Runs the method over the series into `track`.
void track_method(const Method& method, const ParameterMap& parameters, const Series& series,
                  Track& track);

/// The same, and what its metrics against `judged` are: the series itself, or the series denoised.
Outcome run_method(const Method& method, const ParameterMap& parameters, const Series& series,
                   const Series& judged, Track& track);

/// What a track over `series` comes to, judged against `judged`.
Outcome judge_track(const Series& series, const Series& judged, const Track& track);

/// Noise of signals that the trials of a study never see: for calibration and tuning.
Noise calibration_noise(std::uint64_t seed, std::uint32_t trial);

/// What the method is told for this signal, before its own overrides.
ParameterMap told_parameters(const Cell& cell, const Method& method, const Calibration& calibration,
                             const Series& series);

/// The calibration signal of trial `trial`, of the same scenario under other noise. The calibration
/// for the whole cell is that of trial 0.
Calibration calibrate_cell(const Cell& cell, std::uint64_t seed, std::uint32_t trial,
                           Series& buffer);

/// Trial number `trial` of a cell. `shared` is used unless the cell calibrates each trial. What a
/// method throws is its outcome; what signal or calibration throw is the outcome of all. Only a
/// lack of memory is thrown on.
Record run_trial(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                 std::uint32_t trial, Workspace& workspace);

}  // namespace gyrostat
