#include <gyrostat/analysis/statistics/random_effects.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrostat {
namespace {

double sum_of_weights(std::span<const MemberValue> all, double variance) {
  double sum = 0.0;
  for (const auto& k : all) sum += 1.0 / (k.error * k.error + variance);
  return sum;
}

double weighted_mean(std::span<const MemberValue> all, double variance) {
  double sum = 0.0;
  for (const auto& k : all) sum += k.value / (k.error * k.error + variance);
  return sum / sum_of_weights(all, variance);
}

/// Of values without errors, where weights would be infinite.
RandomEffects of_exact(std::span<const MemberValue> members) {
  const auto n = static_cast<double>(members.size());
  double mean = 0.0, squares = 0.0;
  for (const auto& k : members) mean += k.value / n;
  for (const auto& k : members) squares += (k.value - mean) * (k.value - mean);
  const double spread = std::sqrt(squares / (n - 1.0));
  return {.mean = mean, .mean_error = spread / std::sqrt(n), .spread = spread};
}

}  // namespace

double q_between(std::span<const MemberValue> members, double variance) {
  const double mean = weighted_mean(members, variance);
  double q = 0.0;
  for (const auto& k : members)
    q += (k.value - mean) * (k.value - mean) / (k.error * k.error + variance);
  return q;
}

double spread_at(std::span<const MemberValue> members, double q) {
  if (q_between(members, 0.0) <= q) return 0.0;
  double low = 0.0, high = 0.0;
  for (const auto& k : members) high = std::max(high, std::abs(k.value) + k.error);
  while (q_between(members, high * high) > q && high < 1e12) high *= 2.0;
  for (int halving = 0; halving < 80; ++halving) {
    const double middle = 0.5 * (low + high);
    (q_between(members, middle * middle) > q ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

RandomEffects random_effects(std::span<const MemberValue> members) {
  assert(members.size() > 1);
  if (std::all_of(members.begin(), members.end(), [](const auto& k) { return k.error == 0.0; }))
    return of_exact(members);
  const double degrees = static_cast<double>(members.size()) - 1.0;
  const double spread = spread_at(members, degrees), variance = spread * spread;
  const double q = std::max(1.0, q_between(members, variance) / degrees);
  return {.mean = weighted_mean(members, variance),
          .mean_error = std::sqrt(q / sum_of_weights(members, variance)),
          .spread = spread};
}

}  // namespace gyrostat
