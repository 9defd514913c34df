#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/set_dials.hpp>

namespace gyrostat::gap {

std::pair<Eigen::VectorXd, Eigen::VectorXd> SetFitter::coefficients_over_walks(
    const Scenario& scenario) const {
  const double white = scenario.random_error.measurement_noise_std_dps;
  const double least = 0.01 * white / std::sqrt(reduced_->cluster_s() / conditions_.interval_s());
  std::vector<double> weights;
  std::vector<SlowTerms> each;
  double best = -1e300;
  for (double factor = 1.0; factor < 300.0; factor *= 1.6) {
    const auto there = with_walk_of_at_least(with_walk_times(scenario, 1e-6), factor * least);
    auto tried = terms(there, Jumping::no);
    weights.push_back(tried.log_likelihood + std::log(factor));
    best = std::max(best, weights.back());
    each.push_back(std::move(tried.slow));
  }
  double sum = 0.0;
  for (double& w : weights) sum += w = std::exp(w - best);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(each.front().coefficients.size());
  Eigen::VectorXd square = mean;
  for (std::size_t k = 0; k < each.size(); ++k) {
    const double share = weights[k] / sum;
    mean += share * each[k].coefficients;
    square += share * (each[k].coefficients.cwiseAbs2() + each[k].coefficients_std.cwiseAbs2());
  }
  return {mean, (square - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt()};
}

SetFitter::Amplitude SetFitter::amplitude_of(const Scenario& scenario, std::size_t effect) const {
  auto at = static_cast<std::size_t>(drift_.cols());
  for (std::size_t k = 0; k < effect; ++k)
    if (const auto* cause = cause_types().find(scenario.effects[k].id());
        cause != nullptr && cause->signature == Signature::slow)
      at += amplitudes_of(scenario.effects[k], *cause).size();
  const double spread = regressors_of(scenario).spreads[at];
  const auto errors = coefficients_over_walks(scenario).second;
  // Where hardly a mean is seen, no size of it is.
  if (errors.size() == 0) return {std::numeric_limits<double>::infinity(), amplitude_dps_ / spread};
  return {errors[static_cast<Eigen::Index>(at)] / spread, amplitude_dps_ / spread};
}

std::vector<ParameterInterval> SetFitter::intervals(const SetFit& fit) const {
  constexpr double two_sided_95 = 1.959964;
  std::vector<ParameterInterval> found;
  const auto dials = dials_of(fit.scenario);
  const auto here = terms(fit.scenario, Jumping::no);
  const auto slopes = slopes_of(fit.scenario, dials, here, Jumping::no);
  Eigen::MatrixXd information =
      slopes.slow.transpose() * slopes.slow + slopes.fast.transpose() * slopes.fast;
  information.diagonal().array() += 1e-6;  // what nothing is known of has an interval, too
  const Eigen::MatrixXd covariance = invert_symmetric(information).inverse;
  for (std::size_t d = 0; d < dials.size(); ++d) {
    if (!dials[d].place) continue;
    const auto [effect, field] = *dials[d].place;
    const auto at = static_cast<Eigen::Index>(d);
    const double reach = two_sided_95 * std::sqrt(std::max(0.0, covariance(at, at)));
    const auto end = [&](double by) {
      Scenario there = fit.scenario;
      dials[d].set(there, dials[d].get(there) + by);
      return there.effects[effect].value(field);
    };
    const double low = end(-reach), high = end(reach);
    found.push_back({effect, field, low, high});
  }
  if (here.slow.coefficients.size() == 0) return found;
  const auto [coefficients, coefficients_std] = coefficients_over_walks(fit.scenario);
  const auto spreads = regressors_of(fit.scenario).spreads;
  auto at = static_cast<std::size_t>(drift_.cols());
  for (std::size_t k = 0; k < fit.scenario.effects.size(); ++k) {
    const auto& effect = fit.scenario.effects[k];
    const auto* cause = cause_types().find(effect.id());
    if (cause == nullptr || cause->signature != Signature::slow) continue;
    for (const auto field : amplitudes_of(effect, *cause)) {
      const auto c = static_cast<Eigen::Index>(at);
      const auto* besides = known(effect, field);
      const double value =
          (besides != nullptr ? besides->size : 0.0) + coefficients[c] / spreads[at];
      const double reach = two_sided_95 * coefficients_std[c] / spreads[at];
      found.push_back({k, field, value - reach, value + reach});
      ++at;
    }
  }
  return found;
}

}  // namespace gyrostat::gap
