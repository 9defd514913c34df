#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/set_dials.hpp>

namespace gyrostat::gap {
namespace {

bool has_slow_signature(const Scenario& scenario, std::size_t effect) {
  const auto* cause = cause_types().find(scenario.effects[effect].id());
  return cause != nullptr && cause->signature == Signature::slow;
}

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

SetFitter::Slopes SetFitter::slopes_of(const Scenario& scenario, const std::vector<Dial>& dials,
                                       const RateTerms& here, Jumping jumping) const {
  constexpr double step = 1e-3;
  const std::size_t count = dials.size();
  const auto regressors = regressors_of(scenario);
  struct There {
    Scenario scenario;
    RateBands bands;
    bool moves_regressors, is_slow;
  };
  std::vector<There> each(count);
  // Whole, whatever ends what it is part of: no place may stay empty.
  tbb::task_group_context whole(tbb::task_group_context::isolated);
  const auto for_each_dial = [&](const auto& body) {
    tbb::parallel_for(std::size_t{0}, count, body, whole);
  };
  for_each_dial([&](std::size_t d) {
    auto& there = each[d];
    there.scenario = scenario;
    dials[d].set(there.scenario, dials[d].get(scenario) + step);
    there.bands = rate_bands(*reduced_, law_for(there.scenario, jumping));
    there.moves_regressors = dials[d].place && has_slow_signature(scenario, dials[d].place->effect);
    there.is_slow = there.moves_regressors || !there.bands.slow.remembers_as(here.bands.slow);
  });
  // To cluster means, all that is fast is white noise: of one such dial the means are filtered
  // anew, and of the others as much of the difference is taken.
  const auto whiter_by = [&](std::size_t d) {
    return each[d].bands.slow.white - here.bands.slow.white;
  };
  std::size_t whitest = count;
  for (std::size_t d = 0; d < count; ++d)
    if (!each[d].is_slow && whiter_by(d) != 0.0 &&
        (whitest == count || std::abs(whiter_by(d)) > std::abs(whiter_by(whitest))))
      whitest = d;
  std::vector<SlowTerms> filtered(count);
  for_each_dial([&](std::size_t d) {
    if (!each[d].is_slow && d != whitest) return;
    filtered[d] = slow_terms_of(
        each[d].bands.slow, each[d].moves_regressors ? regressors_of(each[d].scenario) : regressors,
        &here.slow, true);
  });
  // Beside jumps each evaluation goes on from what histories say here: so does this one.
  const auto& jumps = here.bands.slow.jumps;
  const auto slow_here =
      jumps ? slow_terms_of(here.bands.slow, regressors, &here.slow, true) : here.slow;
  const auto rows = static_cast<Eigen::Index>(slow_here.innovations.size());
  const auto& log_density = here.bands.fast.log_density;
  const auto bins = static_cast<Eigen::Index>(log_density.size());
  const auto columns = static_cast<Eigen::Index>(count);
  Slopes slopes{.slow = Eigen::MatrixXd::Zero(2 * rows + 1, columns),
                .fast = Eigen::MatrixXd::Zero(bins, columns),
                .slow_gradient = Eigen::VectorXd::Zero(columns),
                .fast_gradient = Eigen::VectorXd::Zero(columns)};
  const double root = std::sqrt(reduced_->degrees());
  for (std::size_t d = 0; d < count; ++d) {
    const auto column = static_cast<Eigen::Index>(d);
    const auto& fast = each[d].bands.fast;
    slopes.fast_gradient[column] = (fast.log_likelihood - here.bands.fast.log_likelihood) / step;
    for (Eigen::Index k = 0; k < bins; ++k) {
      const auto i = static_cast<std::size_t>(k);
      slopes.fast(k, column) = root * (fast.log_density[i] - log_density[i]) / step;
    }
    const std::size_t from = each[d].is_slow ? d : whitest;
    if (from == count) continue;
    const double share = from == d ? 1.0 : whiter_by(d) / whiter_by(from);
    const auto& slow = filtered[from];
    slopes.slow_gradient[column] = share * (slow.log_likelihood - slow_here.log_likelihood) / step;
    for (Eigen::Index k = 0; k < rows; ++k) {
      const auto i = static_cast<std::size_t>(k);
      slopes.slow(k, column) =
          share * std::sqrt(0.5) * (slow.log_variances[i] - slow_here.log_variances[i]) / step;
      slopes.slow(rows + k, column) =
          share * (slow.innovations[i] - slow_here.innovations[i]) / step;
    }
    // Were all jumps known, their number would say as much of their rate.
    if (jumps && from == d)
      slopes.slow(2 * rows, column) =
          std::sqrt(jumps->per_s * here.bands.slow.interval_s * static_cast<double>(rows)) *
          std::log(each[d].bands.slow.jumps->per_s / jumps->per_s) / step;
  }
  return slopes;
}

SetFit SetFitter::maximise(const Scenario& start, int iterations, Jumping jumping,
                           std::string_view held) const {
  SetFit fit{.scenario = start, .drift = {}};
  auto dials = dials_of(start);
  std::erase_if(dials, [&](const Dial& dial) { return !held.empty() && dial.of == held; });
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
