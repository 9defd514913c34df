#include <gyrostat/diagnosis/starts/start.hpp>

#include <algorithm>

namespace gyrostat::gap {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<double> train_steps(const Evidence& e) {
  std::vector<double> steps;
  for (const auto& span : e.simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      steps.push_back(e.scene.rate_error_dps[i] - e.scene.rate_error_dps[i - 1]);
  return steps;
}

Rest with_white(const Evidence& e, double white_std_dps) {
  Rest rest{e.baseline.random_error, e.baseline.thermal_drift};
  rest.random_error.measurement_noise_std_dps = white_std_dps;
  return rest;
}

}  // namespace gyrostat::gap
