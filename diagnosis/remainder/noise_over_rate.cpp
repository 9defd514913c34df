#include <gyrostat/diagnosis/remainder/noise_over_rate.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/gap/lens.hpp>
#include <gyrostat/generators/effects/empirical_noise_over_rate.hpp>

namespace gyrostat::gap {
namespace {

using Spline = effects::EmpiricalNoiseOverRate;
constexpr double fewest_steps = 50.0;

/// Half the logarithm of the mean squared step about each knot; NaN where there are few.
std::vector<double> log_sizes(const Conditions& conditions, const std::vector<double>& error,
                              double fastest_dps) {
  const auto& rate = conditions.series().rate_ref_dps;
  std::vector<double> sums(Spline::knots, 0.0), counts(Spline::knots, 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      const double change = error[i] - error[i - 1];
      if (is_missing(change) || is_missing(rate[i])) continue;
      const auto knot =
          static_cast<std::size_t>(std::llround(Spline::place_of(rate[i], fastest_dps)));
      sums[knot] += change * change;
      counts[knot] += 1.0;
    }
  for (std::size_t k = 0; k < sums.size(); ++k)
    sums[k] = counts[k] < fewest_steps ? no_value : 0.5 * level(sums[k] / counts[k]);
  return sums;
}

}  // namespace

std::optional<Nameless> noise_over_rate_part(const Conditions& conditions,
                                             const Replicated& replicated) {
  if (!conditions.has_motion()) return std::nullopt;
  double fastest_dps = 0.0;
  for (const double rate : conditions.series().rate_ref_dps)
    if (!is_missing(rate)) fastest_dps = std::max(fastest_dps, std::abs(rate));
  const auto observed = log_sizes(conditions, replicated.recording.error_dps, fastest_dps);
  std::vector<std::vector<double>> replicas;
  for (const auto& replica : replicated.replicas)
    replicas.push_back(log_sizes(conditions, replica.error_dps, fastest_dps));
  std::vector<double> off(Spline::knots, no_value), weight(Spline::knots, 0.0);
  double sum = 0.0, weights = 0.0;
  for (std::size_t k = 0; k < Spline::knots; ++k) {
    if (is_missing(observed[k])) continue;
    std::vector<double> at_knot;
    for (const auto& replica : replicas) at_knot.push_back(replica[k]);
    const Against size(observed[k], at_knot);
    off[k] = size.off;
    weight[k] = 1.0 / std::max(size.variance, 1e-12);
    sum += weight[k] * off[k];
    weights += weight[k];
  }
  if (weights == 0.0) return std::nullopt;
  double chi_squared = 0.0, freedom = -1.0;
  for (std::size_t k = 0; k < Spline::knots; ++k)
    if (weight[k] > 0.0) {
      chi_squared += weight[k] * std::pow(off[k] - sum / weights, 2);
      freedom += 1.0;
    }
  if (0.5 * chi_squared - freedom < clear_gain) return std::nullopt;
  // Where few samples tell, the nearest knot that does.
  for (std::size_t k = 1; k < Spline::knots; ++k)
    if (is_missing(off[k])) off[k] = off[k - 1];
  for (std::size_t k = Spline::knots - 1; k-- > 0;)
    if (is_missing(off[k])) off[k] = off[k + 1];
  Effect effect = Spline{.fastest_dps = fastest_dps};
  for (std::size_t k = 0; k < Spline::knots; ++k) effect.value(1 + k) = std::exp(off[k]);
  return Nameless{effect,
                  fmt::format("noise that is {:.2g} times as large at {:.2g} dps and {:.2g} "
                              "times at rest",
                              std::exp(off.back()), fastest_dps, std::exp(off.front()))};
}

}  // namespace gyrostat::gap
