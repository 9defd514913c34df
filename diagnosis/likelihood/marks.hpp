#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/silent_zone.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// What the values of a recording show beyond doubt, before anything is fitted.
struct Marks {
  double lsb_dps = 0.0;               ///< step of the grid that the values lie on; 0: none
  double noise_of_steps_dps = 0.0;    ///< of what changes from sample to sample, robustly
  bool turns_through_grid = false;    ///< a motion takes most samples from one step to others
  double white_under_grid_dps = 0.0;  ///< white noise that moves as many samples across the grid
  /// Where the output rests on two or three values: what the noise is about.
  std::optional<double> level_on_grid_dps;
  double grid_offset_dps = 0.0;    ///< a value of the grid
  double stale_probability = 0.0;  ///< chance that a repeat begins at a sample; 0: no repeats
  double stale_run = 1.0;          ///< mean length of a repeat
  bool stale_is_regular = false;   ///< whether repeats come at even distances
  std::size_t stale_back = 1;      ///< how many samples old what is repeated is
  bool repeats_are_told = true;    ///< from neighbours that are equal by chance
  double limit_dps = 0.0;          ///< beyond which the output is clipped; 0: none is
  double below_dps = 0.0;          ///< as far below zero; 0: as above
  std::vector<char> clipped;       ///< a flag a sample, where there is a limit
  SilentZone silent;               ///< where the output is written as 0
  std::vector<char> repeats;  ///< a flag a sample: repeats the one before, where there are such

  /// On a value's side of zero.
  double limit_at(double value_dps) const {
    return value_dps < 0.0 && below_dps > 0.0 ? below_dps : limit_dps;
  }
};

/// Standard deviation of what changes from sample to sample beside the reference rate, robustly,
/// where a share of the samples are repeated.
double noise_of_steps(const Conditions& conditions, const std::vector<double>& gyro_dps,
                      double repeated = 0.0);

/// The step of the grid that the values of the train part lie on, where so few are used that they
/// repeat, or where a motion spreads values over many steps that are not small to the noise; 0
/// where they lie on none.
double step_of_grid(const Simulator& simulator, const std::vector<double>& gyro_dps,
                    double noise_dps);

/// Reads the train part for the numbers, all samples for the flags.
Marks marks_of(const Simulator& simulator, const Series& recording);

}  // namespace gyrostat::gap
