#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gyrostat/core/outcome.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// One trial: every method on the same signal.
struct Record {
  std::vector<double> numbers{};  ///< of all methods, in the cell's order, as the store has them
  std::vector<std::string> thrown{};  ///< by method: what it threw; empty where it did not
  bool calibration_converged = true;

  Outcome of(std::size_t method) const { return TrialOutcomes(numbers, thrown.size())[method]; }
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

/// What the trial's signal is made of: the cell's scenario, or `drawn`, into which the sensor of
/// the trial is put where there is a fleet to draw it from. Every method of the trial meets this
/// sensor.
const Scenario& sensor_of(const Cell& cell, const Noise& trial, Scenario& drawn);

/// The signal of trial `trial` of a cell into `series`, or that under any noise.
void make_trial(const Cell& cell, std::uint64_t seed, std::uint32_t trial, Series& series);
void make_trial(const Cell& cell, const Noise& noise, Series& series);

/// What the methods' output is judged against: the series, with its rate denoised in `buffer` where
/// the cell asks for that.
const Series& judged_series(const Cell& cell, const Series& series, Series& buffer);

/// Runs the method over the series into `track`.
void track_method(const Method& method, const ParameterMap& told, const Series& series,
                  Track& track);

/// The numbers of an Outcome: what a track over `series` comes to, judged against `judged`.
std::vector<double> judge_track(const Series& series, const Series& judged, const Track& track);

/// Noise of signals that the trials of a study never see: for calibration and tuning.
Noise calibration_noise(std::uint64_t seed, std::uint32_t trial);
/// That of a trial's own calibration: mixed as the trial's.
Noise calibration_noise(const Noise& trial);

/// What the method is told for this signal of `sensor`, before its own overrides: the calibration's
/// parameters, or the sensor's own where its parameters are from the truth.
ParameterMap told_parameters(const Cell& cell, const Scenario& sensor, const Method& method,
                             const Calibration& calibration, const Series& series);

/// The calibration signal of trial `trial`, of the same scenario under other noise. The calibration
/// for the whole cell is that of trial 0. Or that under the noise of any trial. Of a fleet, the
/// calibration for the whole cell is of the nominal sensor, that of each trial of its own.
Calibration calibrate_cell(const Cell& cell, std::uint64_t seed, std::uint32_t trial,
                           Series& buffer);
Calibration calibrate_cell(const Cell& cell, const Noise& trial, Series& buffer);

/// A trial's signal into `workspace.series` and what one method makes of it into `workspace.track`,
/// for who wants to see every step: those that the trial's Record was made of.
void track_trial(const Cell& cell, const Method& method, const Calibration& shared,
                 const Noise& trial, Workspace& workspace);

}  // namespace gyrostat
