#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <gyrostat/analysis/rare/subset_simulation.hpp>

namespace gyrostat {

/// Trials whose deviates are moved along one direction, and a part of them against it.
struct ImportancePlan {
  double shift = 0.0;      ///< in standard deviations
  double same_side = 1.0;  ///< share of the trials that are moved along it
  std::uint32_t trials = 4000;
  std::uint32_t batches = 8;  ///< for the interval

  /// By how much the deviates of a trial are moved along the direction. Trial i is of batch
  /// i % batches; each batch has both sides in the same shares.
  double shift_of(std::uint32_t trial) const;
  /// How much less likely deviates are than the plan makes them, by their component along the
  /// direction once moved: the ratio of the standard normal density to the mixture of the two sides
  /// (the balance heuristic: Veach and Guibas, SIGGRAPH 1995).
  double weight(double along) const;

 private:
  double moved_along() const;
};

/// A plan for a failure at whose edge the direction's point lies `edge` from no deviates at all.
/// The direction is off what leads to the failure by an angle of cosine `closeness`; were the edge
/// flat, it would be edge * closeness away, and this shift has the least variance to leading order.
ImportancePlan importance_plan(double edge, double closeness, double same_side);

/// The probability by the plan's trials: of each its weight where it failed, else 0. Importance
/// sampling about the design point (Shinozuka, J. Struct. Eng. 109, 1983; Melchers, Struct. Saf. 6,
/// 1989) is exact in the mean whatever the direction is; how far it may be off is told by how
/// batches differ, as runs of subset simulation do. Nothing where a batch has fewer than five.
std::optional<RareProbability> importance_probability(const ImportancePlan& plan,
                                                      std::span<const double> weights);

/// Whether two such probabilities of one failure differ by more than they do in one study of a
/// thousand.
bool disagree(const RareProbability& a, const RareProbability& b, double degrees);

}  // namespace gyrostat
