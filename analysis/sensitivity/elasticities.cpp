#include "analysis/sensitivity/estimators.hpp"
#include "analysis/sensitivity/paired_trials.hpp"

namespace gyrostat {
namespace {

double mean_of(const Outputs& outputs, std::size_t point) {
  double sum = 0.0;
  const auto trials = common_trials(outputs, {point});
  for (const auto t : trials) sum += outputs.at(point, t);
  return sum / static_cast<double>(trials.size());
}

}  // namespace

std::vector<Elasticity> elasticities(const Outputs& outputs, std::span<const Span> spans,
                                     Resampler& resampler) {
  std::vector<Elasticity> all;
  for (std::size_t p = 0; p < spans.size(); ++p) {
    const auto& span = spans[p];
    const std::size_t low = 1 + 2 * p, high = low + 1;
    // Each trial is a row: its slope times the parameter, and its output at the base.
    CrossedRows rows(2, 0);
    for (const auto t : common_trials(outputs, {0, low, high})) {
      const double slope =
          (outputs.at(high, t) - outputs.at(low, t)) / (span.high - span.low);
      rows.add({{slope * span.base, outputs.at(0, t)}});
    }
    Elasticity elasticity;
    elasticity.value = bootstrapped(rows, [](auto m) { return m[0] / m[1]; }, resampler);
    elasticity.low_output = mean_of(outputs, low);
    elasticity.high_output = mean_of(outputs, high);
    all.push_back(elasticity);
  }
  return all;
}

}  // namespace gyrostat
