#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

class Conditions;

/// A recording that one could make, and how surely it would tell two causes apart.
struct NextExperiment {
  std::string what;
  std::string first, second;    ///< the effects that it separates
  double expected_power = 0.0;  ///< share of simulated recordings, half made by either, that score
                                ///< higher under their own cause

  /// So many are right at least where a recording is said to tell them apart.
  static constexpr double least_power = 0.7;
  bool tells_apart() const { return expected_power >= least_power; }
};

/// Of longer static recordings, one of a night, slower and faster temperature cycles, a rate table
/// and turns on the spot, the one that best separates two enriched scenarios whose last effects are
/// the causes, `none` where there is none: recordings are simulated under each and scored under
/// both.
NextExperiment next_experiment(const Scenario& first, const Scenario& second, double recorded_s,
                               std::uint64_t seed, const Interrupt& interrupt = {});

/// Of what happened once; its `nearest` and power are as below.
NextExperiment undisturbed_recording(const std::string& nearest);

/// Of what nothing explains, in the gyro or in the compass alone: longer, and with what the
/// recording does not hold. `nearest` is the effect that comes nearest, or nothing. Its power is 0:
/// there is nothing to simulate.
NextExperiment wider_recording(const Conditions& conditions, double recorded_s,
                               const std::string& nearest, bool of_compass_alone);

}  // namespace gyrostat::gap
