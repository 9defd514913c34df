#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {
namespace {

bool has_slow_signature(const Scenario& scenario, std::size_t effect) {
  const auto* cause = cause_types().find(scenario.effects[effect].id());
  return cause != nullptr && cause->signature == Signature::slow;
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
    there.bands = rate_bands(*reduced_, law_for(there.scenario, jumping), here.bands.parts);
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

}  // namespace gyrostat::gap
