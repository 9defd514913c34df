#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// A recording that one could make, and how surely it would tell two causes apart.
struct NextExperiment {
  std::string what;
  std::string first, second;    ///< the effects that it separates
  double expected_power = 0.0;  ///< share of simulated recordings, half made by either, that score
                                ///< higher under their own cause
};

/// Of longer static recordings, slower and faster temperature cycles, a rate table and turns on the
/// spot, the one that best separates two enriched scenarios whose last effects are the causes:
/// recordings are simulated under each and scored under both.
NextExperiment next_experiment(const Scenario& first, const Scenario& second, double recorded_s,
                               std::uint64_t seed, const Interrupt& interrupt = {});

}  // namespace gyrostat::gap
