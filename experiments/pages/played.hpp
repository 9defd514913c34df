#pragma once

#include <span>
#include <string>
#include <vector>

#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// A trial of a cell once more, with what every sample came to: its signal, and the tracks of
/// methods.
struct Played {
  Series series;
  std::vector<std::string> ids;
  std::vector<Track> tracks;

  /// gyro - estimate - true rate of the track of method `m`, sample by sample.
  std::vector<double> rate_errors_dps(std::size_t m) const;
};

/// Plays trial `trial` of `cell`, whose result tells calibration and tuning, with the methods of
/// those indices.
Played play(const Cell& cell, const CellResult& result, std::uint64_t seed, std::uint32_t trial,
            std::span<const std::size_t> methods);

/// The Allan deviation of a trial's compensated rate at each of `taus_s`, one row a method; NaN at
/// a tau shorter than a sample or longer than half the signal.
std::vector<std::vector<double>> allan_deviations(const Played& played,
                                                  std::span<const double> taus_s);

}  // namespace gyrostat
