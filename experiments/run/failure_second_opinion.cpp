#include <gyrostat/experiments/run/failure_second_opinion.hpp>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/rare/common_direction.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>

namespace gyrostat {
namespace {

NoiseTape scaled(const NoiseTape& tape, double by) {
  auto out = tape;
  for (auto& [name, values] : out)
    for (double& v : values) v *= by;
  return out;
}

/// How far along the direction, from no deviates at all, the failure's edge is; nothing where even
/// ten standard deviations do not fail.
std::optional<double> edge_along(const NoiseTape& unit,
                                 const std::function<double(const Noise&)>& badness, double allowed,
                                 std::uint64_t seed) {
  const NoiseShare none{0, 0.0};
  const auto fails = [&](double distance) {
    const auto shift = scaled(unit, distance);
    return badness({.seed = seed, .shares = {&none, 1}, .shift = &shift}) > allowed;
  };
  double low = 0.0, high = 2.5;
  while (!fails(high)) {
    low = high;
    high *= 1.4142135623730951;
    if (high > 11.0) return std::nullopt;
  }
  for (int step = 0; step < 10; ++step) {
    const double middle = 0.5 * (low + high);
    (fails(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

std::optional<SecondOpinion> second_opinion(const PreparedCell& prepared, const FailureRule& rule,
                                            const FailingMeans& means, std::uint32_t first,
                                            std::uint64_t seed) {
  const auto direction = common_direction(means.of_runs);
  if (!direction) return std::nullopt;
  tbb::enumerable_thread_specific<std::vector<Workspace>> workspaces(1);
  const auto badness = [&](const Noise& noise) {
    const auto record = run_trial(prepared.cell, prepared.calibration, noise, workspaces.local());
    return rule.badness(record.of(0).metric(rule.metric));
  };
  const auto edge = edge_along(direction->unit, badness, rule.worst_allowed(), seed);
  if (!edge) return std::nullopt;
  const auto plan = importance_plan(*edge, direction->closeness, means.same_side);
  const auto with = scaled(direction->unit, plan.shift),
             against = scaled(direction->unit, -plan.shift);
  std::vector<double> weights(plan.trials, 0.0);
  tbb::parallel_for(std::uint32_t{0}, plan.trials, [&](std::uint32_t i) {
    const NoiseShare own{first + i, 1.0};
    const Noise noise{.seed = seed,
                      .trial = first + i,
                      .shares = {&own, 1},
                      .shift = plan.shift_of(i) > 0.0 ? &with : &against};
    if (badness(noise) > rule.worst_allowed())
      weights[i] = plan.weight(along(*direction, noise, calibration_noise(noise)));
  });
  return SecondOpinion{direction->closeness, plan.trials, importance_probability(plan, weights)};
}

}  // namespace gyrostat
