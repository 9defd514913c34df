#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

namespace gyrostat::gap {

/// What the first parameters of one more effect are guessed from: a fitted set, and what it leaves.
struct Beside {
  const Conditions& conditions;
  const SetFitter& fitter;
  const SetFit& fit;
  bool is_moved = false;  ///< it leaves something of the motion, which is in slow lines, too

  /// Standard deviation of a cluster mean that the set leaves, or of its step to the next.
  double slow_std_dps() const;
  /// From a few clusters to a sixth of the recording, four times apart.
  std::vector<double> memories_s() const;
  double middle_temperature_C() const;
  /// Bands that hold more than the set explains, the clearest of each width first.
  std::vector<Resonance> lines() const;

 private:
  /// Those that cluster means show.
  std::vector<Resonance> slow_lines() const;
};

}  // namespace gyrostat::gap
