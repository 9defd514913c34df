#pragma once

#include <gyrostat/core/parameter_map.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

/// The scenario's own parameters, for the oracle and for filters that are told the truth.
ParameterMap true_parameters(const Scenario& scenario);

}  // namespace gyrostat
