#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/likelihood/set_dials.hpp>

namespace gyrostat::gap {
namespace {

/// Takes into a curvature how much steeper a climb has become along a step (BFGS with Powell's
/// damping: Nocedal and Wright, "Numerical Optimization", 2nd ed. 2006, 18.2).
void bend(Eigen::MatrixXd& curvature, const Eigen::VectorXd& step, Eigen::VectorXd lost) {
  const Eigen::VectorXd expected = curvature * step;
  const double length = step.dot(expected);
  if (!(length > 0.0)) return;
  constexpr double least = 0.2;
  if (const double seen = step.dot(lost); seen < least * length) {
    const double share = (1.0 - least) * length / (length - seen);
    lost = share * lost + (1.0 - share) * expected;
  }
  curvature += lost * lost.transpose() / step.dot(lost);
  curvature -= expected * expected.transpose() / length;
}

/// The maximum of gradient' x - x' curvature x / 2 where no |x| is beyond `furthest`, nearly: what
/// goes there stays there, and the others move beside it.
Eigen::VectorXd step_within(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& gradient,
                            const std::vector<Dial>& dials) {
  Eigen::MatrixXd left = curvature;
  Eigen::VectorXd pull = gradient, step = Eigen::VectorXd::Zero(gradient.size());
  std::vector<char> ends(dials.size(), 0);
  for (bool moved = true; moved;) {
    moved = false;
    const Eigen::VectorXd free = solve_symmetric(left, pull);
    for (std::size_t d = 0; d < dials.size(); ++d) {
      if (ends[d] != 0) continue;
      const auto at = static_cast<Eigen::Index>(d);
      step[at] = free[at];
      if (std::abs(free[at]) <= dials[d].furthest) continue;
      ends[d] = 1;
      moved = true;
      step[at] = std::copysign(dials[d].furthest, free[at]);
      pull -= step[at] * curvature.col(at);
      left.row(at).setZero();
      left.col(at).setZero();
      left(at, at) = 1.0;
    }
    for (std::size_t d = 0; d < dials.size(); ++d)
      if (ends[d] != 0) pull[static_cast<Eigen::Index>(d)] = 0.0;
  }
  return step;
}

}  // namespace

SetFit SetFitter::maximise(const Scenario& start, int iterations, Jumping jumping,
                           const std::function<bool(const Dial&)>& held) const {
  SetFit fit{.scenario = start, .drift = {}};
  auto dials = dials_of(start);
  if (held) std::erase_if(dials, held);
  const auto count = static_cast<Eigen::Index>(dials.size());
  const auto places_of = [&](const Scenario& scenario) {
    Eigen::VectorXd places(count);
    for (Eigen::Index d = 0; d < count; ++d)
      places[d] = dials[static_cast<std::size_t>(d)].get(scenario);
    return places;
  };
  fit.parameters = dials.size();
  RateTerms here = terms(fit.scenario, jumping);
  // Beside jumps the curvature is begun as if they were known, which is too much (Louis, J. R.
  // Stat. Soc. B 44, 1982), and what it is learnt on the way: that takes longer.
  const bool jumps = here.bands.slow.jumps.has_value();
  constexpr int few = 6;
  if (jumps && iterations > few) iterations *= 2;
  Eigen::MatrixXd curvature;
  Eigen::VectorXd places = places_of(fit.scenario), places_before, slow_gradient_before;
  constexpr double first_damping = 1e-2;
  double damping = first_damping;
  bool is_learnt = false;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const auto slopes = slopes_of(fit.scenario, dials, here, jumping);
    const Eigen::VectorXd gradient = slopes.slow_gradient + slopes.fast_gradient;
    if (!is_learnt)
      curvature = slopes.slow.transpose() * slopes.slow;
    else
      bend(curvature, places - places_before, slow_gradient_before - slopes.slow_gradient);
    const Eigen::MatrixXd information = curvature + slopes.fast.transpose() * slopes.fast;
    bool better = false, settled = false;
    for (int attempt = 0; attempt < 4 && !better; ++attempt) {
      Eigen::MatrixXd damped = information;
      damped.diagonal() +=
          damping * information.diagonal() + Eigen::VectorXd::Constant(count, 1e-3);
      Eigen::VectorXd by = step_within(damped, gradient, dials);
      constexpr double shorter = 0.3;
      if (jumps) by *= std::pow(shorter, attempt);
      const Scenario trial = moved(fit.scenario, dials, by);
      auto there = terms(trial, jumping, &here.slow);
      if (there.log_likelihood > here.log_likelihood) {
        settled = there.log_likelihood - here.log_likelihood < 0.02;
        fit.scenario = trial;
        here = std::move(there);
        better = true;
        damping *= 0.2;
      } else if (!jumps) {
        damping = std::max(10.0 * damping, 0.1);
      }
    }
    // What was learnt of a curvature elsewhere may be wrong here.
    const bool ends = !better || settled;
    if (ends && !is_learnt) break;
    is_learnt = jumps && !ends;
    if (ends) damping = first_damping;
    places_before = std::exchange(places, places_of(fit.scenario));
    slow_gradient_before = slopes.slow_gradient;
  }
  fit.log_likelihood = here.log_likelihood;
  take_coefficients(here, fit);
  return fit;
}

}  // namespace gyrostat::gap
