#include <gyrostat/diagnosis/likelihood/felt_acceleration.hpp>

#include <algorithm>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

/// Straight between the middles of clusters, a value a sample.
std::vector<double> between_means(const Conditions& conditions, const std::vector<double>& means) {
  const auto cluster = static_cast<double>(conditions.cluster());
  std::vector<double> values(conditions.size(), no_value);
  for (std::size_t i = 0; i < values.size() && !means.empty(); ++i) {
    const double at = std::clamp((static_cast<double>(i) + 0.5) / cluster - 0.5, 0.0,
                                 static_cast<double>(means.size() - 1));
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, means.size() - 1);
    values[i] = means[low] + (at - static_cast<double>(low)) * (means[high] - means[low]);
  }
  return values;
}

}  // namespace

void keep_what_shows(const Conditions& conditions, const std::vector<char>& masked,
                     const std::vector<double>& error, std::vector<double>& felt) {
  auto counted = felt, shown = error;
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (masked[i] != 0 || is_missing(error[i]) || is_missing(felt[i]))
      counted[i] = shown[i] = no_value;
  const auto slow = between_means(conditions, conditions.slow_means(counted));
  const auto slow_error = between_means(conditions, conditions.slow_means(shown));
  double squares = 0.0, products = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      const double fast = counted[i] - slow[i], of_error = shown[i] - slow_error[i];
      if (is_missing(fast) || is_missing(of_error)) continue;
      squares += fast * fast;
      products += fast * of_error;
    }
  const double share = squares > 0.0 ? std::clamp(products / squares, 0.0, 1.0) : 1.0;
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (!is_missing(slow[i])) felt[i] = slow[i] + share * (felt[i] - slow[i]);
}

}  // namespace gyrostat::gap
