#include <gyrostat/analysis/rare/importance_sampling.hpp>

#include <cassert>
#include <cmath>
#include <vector>

#include <gyrostat/analysis/statistics/distributions.hpp>

namespace gyrostat {
namespace {

constexpr int least_failing = 5;  ///< of a batch: of fewer, how batches differ says little

}  // namespace

double ImportancePlan::moved_along() const {
  const double of_batch = trials / batches;
  return std::floor(of_batch * same_side) / of_batch;
}

double ImportancePlan::shift_of(std::uint32_t trial) const {
  const double in_batch = trial / batches, share = moved_along();
  return std::floor((in_batch + 1.0) * share) > std::floor(in_batch * share) ? shift : -shift;
}

double ImportancePlan::weight(double along) const {
  const double share = moved_along(), out = std::abs(shift * along);
  const double with = shift * along > 0.0 ? share : 1.0 - share;
  // exp(shift^2 / 2) / (share e^(shift along) + (1 - share) e^(-shift along)), without overflow.
  return std::exp(0.5 * shift * shift - out) / (with + (1.0 - with) * std::exp(-2.0 * out));
}

ImportancePlan importance_plan(double edge, double closeness, double same_side) {
  ImportancePlan plan;
  const double squared = closeness * closeness;
  plan.shift = edge * squared / (2.0 - squared);
  plan.same_side = same_side;
  return plan;
}

std::optional<RareProbability> importance_probability(const ImportancePlan& plan,
                                                      std::span<const double> weights) {
  assert(weights.size() == plan.trials && plan.trials % plan.batches == 0);
  std::vector<double> batches(plan.batches, 0.0);
  std::vector<int> failing(plan.batches, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    batches[i % plan.batches] += weights[i] * plan.batches / plan.trials;
    failing[i % plan.batches] += weights[i] > 0.0;
  }
  for (const int count : failing)
    if (count < least_failing) return std::nullopt;
  return rare_probability(batches);
}

bool disagree(const RareProbability& a, const RareProbability& b, double degrees) {
  const double apart = std::abs(std::log(a.probability / b.probability));
  return apart > student_t_two_sided(0.999, degrees) * std::hypot(a.variation, b.variation);
}

}  // namespace gyrostat
