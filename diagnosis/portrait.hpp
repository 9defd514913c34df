#pragma once

#include <vector>

#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

class Simulator;

/// A long series in a few hundred stretches: least, mean and largest value of each; its times are
/// from the first sample.
struct Envelope {
  std::vector<double> t_s, low, mean, high;
};

/// Root spectral densities of the rate error, dps/√Hz.
struct Densities {
  std::vector<double> frequency_hz, recording, before, after;
};

/// A recording as an engineer plots it, for pictures; nothing is decided by it.
struct Portrait {
  Envelope recorded;  ///< dps
  Envelope left;      ///< what drift and effects that are the same in every replica do not explain
  Densities spectrum;
};

/// `before` and `after` are the simulator without and with the effects that were found.
Portrait portrait_of(const Simulator& simulator, const Series& recording, const Scenario& before,
                     const Scenario& after);

}  // namespace gyrostat::gap
