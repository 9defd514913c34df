#include <gyrostat/diagnosis/starts/train_steps.hpp>

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
  for (const auto& span : e.conditions().spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      steps.push_back(e.scene.rate_error_dps[i] - e.scene.rate_error_dps[i - 1]);
  return steps;
}

}  // namespace gyrostat::gap
