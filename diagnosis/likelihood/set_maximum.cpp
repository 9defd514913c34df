#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <algorithm>
#include <cmath>

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

}  // namespace

Eigen::MatrixXd SetFitter::slopes_of(const Scenario& scenario, const std::vector<Dial>& dials,
                                     const RateTerms& here, Jumping jumping,
                                     Eigen::VectorXd* gradient) const {
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
    filtered[d] =
        slow_terms_of(each[d].bands.slow,
                      each[d].moves_regressors ? regressors_of(each[d].scenario) : regressors);
  });
  const auto rows = static_cast<Eigen::Index>(here.slow.innovations.size());
  const auto& log_density = here.bands.fast.log_density;
  const auto bins = static_cast<Eigen::Index>(log_density.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2 * rows + bins, static_cast<Eigen::Index>(count));
  const double root = std::sqrt(reduced_->degrees());
  for (std::size_t d = 0; d < count; ++d) {
    const auto column = static_cast<Eigen::Index>(d);
    const auto& fast = each[d].bands.fast;
    double gained = fast.log_likelihood - here.bands.fast.log_likelihood;
    for (Eigen::Index k = 0; k < bins; ++k) {
      const auto i = static_cast<std::size_t>(k);
      slopes(2 * rows + k, column) = root * (fast.log_density[i] - log_density[i]) / step;
    }
    const std::size_t from = each[d].is_slow ? d : whitest;
    if (from < count) {
      const double share = from == d ? 1.0 : whiter_by(d) / whiter_by(from);
      const auto& slow = filtered[from];
      gained += share * (slow.log_likelihood - here.slow.log_likelihood);
      for (Eigen::Index k = 0; k < rows; ++k) {
        const auto i = static_cast<std::size_t>(k);
        slopes(k, column) =
            share * std::sqrt(0.5) * (slow.log_variances[i] - here.slow.log_variances[i]) / step;
        slopes(rows + k, column) = share * (slow.innovations[i] - here.slow.innovations[i]) / step;
      }
    }
    if (gradient != nullptr) (*gradient)[column] = gained / step;
  }
  return slopes;
}

SetFit SetFitter::maximise(const Scenario& start, int iterations, Jumping jumping,
                           std::string_view held) const {
  SetFit fit{.scenario = start, .drift = {}};
  auto dials = dials_of(start);
  std::erase_if(dials, [&](const Dial& dial) { return !held.empty() && dial.of == held; });
  const auto count = static_cast<Eigen::Index>(dials.size());
  fit.parameters = dials.size();
  RateTerms here = terms(fit.scenario, jumping);
  double damping = 1e-2;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Eigen::VectorXd gradient(count);
    const auto slopes = slopes_of(fit.scenario, dials, here, jumping, &gradient);
    const Eigen::MatrixXd information = slopes.transpose() * slopes;
    bool better = false;
    for (int attempt = 0; attempt < 4 && !better; ++attempt) {
      Eigen::MatrixXd damped = information;
      damped.diagonal() +=
          damping * information.diagonal() + Eigen::VectorXd::Constant(count, 1e-3);
      Eigen::VectorXd by = solve_symmetric(damped, gradient);
      for (Eigen::Index d = 0; d < count; ++d) {
        const double furthest = dials[static_cast<std::size_t>(d)].furthest;
        by[d] = std::clamp(by[d], -furthest, furthest);
      }
      const Scenario trial = moved(fit.scenario, dials, by);
      auto there = terms(trial, jumping);
      if (there.log_likelihood > here.log_likelihood) {
        const bool settled = there.log_likelihood - here.log_likelihood < 0.02;
        fit.scenario = trial;
        here = std::move(there);
        better = true;
        damping *= 0.2;
        if (settled) iteration = iterations;
      } else {
        damping = std::max(10.0 * damping, 0.1);
      }
    }
    if (!better) break;
  }
  fit.log_likelihood = here.log_likelihood;
  take_coefficients(here, fit);
  return fit;
}

}  // namespace gyrostat::gap
