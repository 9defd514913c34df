#include <gyrostat/diagnosis/likelihood/kept_apart.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {

double KeptApart::told_from_dps(double repeated) const {
  constexpr double odds = 0.1;
  const double by_rounding =
      grid_dps / (std::sqrt(2.0 * std::numbers::pi) * std::max(spread_dps, 1e-12));
  const double log_odds = std::log(odds * by_rounding / std::max(repeated, 1e-12));
  return std::min(far_dps, spread_dps * std::sqrt(2.0 * std::max(0.0, log_odds)));
}

KeptApart kept_apart_by_motion(const Conditions& conditions, const std::vector<double>& z,
                               const Marks& marks, double resolution_dps) {
  const auto& reference = conditions.series().rate_ref_dps;
  KeptApart apart;
  if (reference.empty()) return apart;
  // A filter's output has not yet begun to move where its input has.
  constexpr std::size_t around = 4;
  const auto follows = [&](std::size_t i) {
    const std::size_t from = i - 1 - around, to = i + around;
    return 2.0 * std::abs(z[to] - z[from]) >= std::abs(reference[to] - reference[from]);
  };
  const auto each = [&](const auto& look) {
    for (const Part part : both_parts)
      for (const auto& span : conditions.spans(part))
        for (std::size_t i = span.first + 1 + around; i + around < span.last; ++i)
          if (!is_missing(z[i]) && !is_missing(z[i - 1]) && follows(i) &&
              (marks.limit_dps == 0.0 || std::abs(z[i]) < marks.limit_at(z[i])))
            look(i, z[i] - z[i - 1], reference[i] - reference[i - 1]);
  };
  std::vector<double> errors;
  each([&](std::size_t /*i*/, double step, double turned) {
    errors.push_back(std::abs(step - turned));
  });
  if (errors.empty()) return apart;
  constexpr double beyond_noise = 5.0;
  // Most of a coarse grid's errors are 0, whatever the noise under it.
  const double spread = std::max(quantile(std::move(errors), 0.5) / normal_quartile,
                                 std::numbers::sqrt2 * marks.white_under_grid_dps);
  const double far = apart.far_dps = marks.lsb_dps + beyond_noise * spread;
  const double grid = marks.lsb_dps > 0.0 ? marks.lsb_dps : resolution_dps;
  apart.spread_dps = spread;
  apart.grid_dps = grid;
  constexpr double beside = 2.0;  // steps
  double back = 0.0, forth = 0.0;
  const double widest_zone_dps = 0.5 * fastest_dps(conditions);
  each([&](std::size_t i, double step, double turned) {
    // About zero, a dead zone may hold them together. Whether this one is a repeat must not matter.
    const bool may_be_held =
        std::abs(z[i - 1]) <= far &&
        std::max(std::abs(reference[i - 1]), std::abs(reference[i])) <= widest_zone_dps;
    if (std::abs(turned) <= far || may_be_held) return;
    apart.pairs += 1.0;
    apart.still += std::abs(step) <= far ? 1.0 : 0.0;
    apart.equal += step == 0.0 ? 1.0 : 0.0;
    if (step == 0.0 && std::abs(reference[i - 1] - reference[i - 2]) > far) {
      apart.in_a_row += 1.0;
      apart.both_equal += z[i - 1] == z[i - 2] ? 1.0 : 0.0;
    }
    if (step != 0.0 && std::abs(step) < (beside + 0.5) * grid)
      (step * turned < 0.0 ? back : forth) += 1.0;
  });
  apart.by_chance = std::sqrt(back * forth) / beside;
  return apart;
}

}  // namespace gyrostat::gap
