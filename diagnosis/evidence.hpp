#pragma once

#include <algorithm>
#include <limits>

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// What estimates of an effect's parameters are made from.
struct Evidence {
  const Simulator& simulator;
  const Series& recording;
  Scene scene;
  Scenario baseline;  ///< fitted to the recording, with what gives its rate a response
  /// Of the train part's cluster means under the set, at the clusters; 0 elsewhere.
  std::vector<double> slow_innovations = {};
  /// Of the level that walks under the rate error, whatever it is that moves it (WalkingLevel).
  double level_gain = 0.0;
  /// The rate under the baseline's effects, and the heading under none, without noise
  /// (take_undisturbed()).
  std::vector<double> rate_dps = {}, heading_deg = {};
  /// Samples of the gyro that do not count, a flag each, or nothing: what is clipped or repeated
  /// says another thing of the motion.
  std::vector<char> hidden = {};
  /// Half the rate of the samples that count, where they come evenly: what is above it is below it,
  /// too.
  double nyquist_hz = std::numeric_limits<double>::infinity();

  const Conditions& conditions() const { return simulator.conditions(); }
  bool is_filtered() const {
    return std::any_of(baseline.effects.begin(), baseline.effects.end(),
                       [](const Effect& effect) { return effect.id() == "sensor_bandwidth"; });
  }
};

}  // namespace gyrostat::gap
