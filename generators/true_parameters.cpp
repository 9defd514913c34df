#include <gyrostat/generators/true_parameters.hpp>

#include <cmath>

namespace gyrostat {

ParameterMap true_parameters(const Scenario& scenario) {
  ParameterMap values = parameter_values(scenario.random_error);
  values.merge(parameter_values(scenario.thermal_drift));
  values["compass_noise_std_deg"] = scenario.compass.noise_std_deg;
  values["initial_x_dps"] = values["initial_x_previous_dps"] = 0.0;
  // x_{-1} = 0, and x_{-2} lies one stationary difference away from it.
  const auto& [phi, delta1, delta2, noise] = scenario.random_error;
  values["initial_x_std_dps"] = 0.0;
  values["initial_x_previous_std_dps"] = std::sqrt(
      (delta1 * delta1 + delta2 * delta2 - 2.0 * phi * delta1 * delta2) / (1.0 - phi * phi));
  return values;
}

}  // namespace gyrostat
