#include <gyrostat/diagnosis/remainder/compass_tails.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/generators/all_pole.hpp>
#include <gyrostat/generators/effects/empirical_compass_noise.hpp>

namespace gyrostat::gap {
namespace {

using effects::EmpiricalCompassNoise;

double kurtosis_of_steps(const Conditions& conditions, const std::vector<double>& heading) {
  double square = 0.0, fourth = 0.0, count = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      const double step = heading[i] - heading[i - 1];
      if (is_missing(step)) continue;
      square += step * step;
      fourth += step * step * step * step;
      count += 1.0;
    }
  return square > 0.0 ? fourth * count / (square * square) : 3.0;
}

/// Excess kurtosis of the steps of a linear process over that of what drives it: sum of fourth
/// powers of its response over the square of the sum of squares.
double share_in_steps(const EmpiricalCompassNoise& noise) {
  AllPole<EmpiricalCompassNoise::order> response(
      {noise.reflection_1, noise.reflection_2, noise.reflection_3, noise.reflection_4});
  double before = 0.0, square = 0.0, fourth = 0.0;
  constexpr int long_enough = 2000;
  for (int i = 0; i < long_enough; ++i) {
    const double here = response(i == 0 ? 1.0 : 0.0);
    const double step = here - before;
    before = here;
    square += step * step;
    fourth += step * step * step * step;
  }
  return fourth / (square * square);
}

/// Excess kurtosis of sinh(tail n), n normal.
double excess_of(double tail) {
  const double t = tail * tail;
  const double square = 0.5 * std::expm1(2.0 * t);
  const double fourth = (std::expm1(8.0 * t) - 4.0 * std::expm1(2.0 * t)) / 8.0;
  return fourth / (square * square) - 3.0;
}

/// The tail with that excess; excess_of rises with it.
double tail_of(double excess) {
  double low = 1e-3, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess_of(middle) < excess ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::optional<Nameless> compass_tails_part(const Conditions& conditions,
                                           const Replicated& replicated, const Scenario& set) {
  if (replicated.recording.heading_deg.empty()) return std::nullopt;
  EmpiricalCompassNoise noise{.innovation_std_deg = set.compass.noise_std_deg, .reflection_1 = 0.0};
  for (const auto& effect : set.effects) {
    if (effect.id() == "magnetic_bursts") return std::nullopt;
    if (const auto* coloured = effect.as<EmpiricalCompassNoise>()) noise = *coloured;
  }
  if (!(noise.innovation_std_deg > 0.0)) return std::nullopt;
  std::vector<double> kurtoses;
  for (const auto& replica : replicated.replicas)
    kurtoses.push_back(kurtosis_of_steps(conditions, replica.heading_deg));
  const Against kurtosis(kurtosis_of_steps(conditions, replicated.recording.heading_deg), kurtoses);
  if (kurtosis.off <= 0.0 || 0.5 * kurtosis.chi_squared() - 1.0 < clear_gain) return std::nullopt;
  noise.tail = tail_of(kurtosis.off / share_in_steps(noise));
  return Nameless{noise, fmt::format("heavier tails of the compass noise (kurtosis {:.2g} of what "
                                     "drives it)",
                                     3.0 + excess_of(noise.tail))};
}

}  // namespace gyrostat::gap
