#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/arima_law.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {

NoiseLaw law_of(const Scenario& scenario, double interval_s) {
  const auto& e = scenario.random_error;
  const auto arima = ArimaLaw::of(e);
  NoiseLaw law{.interval_s = interval_s,
               .duration_s = scenario.sampling.duration_s,
               .white = e.measurement_noise_std_dps * e.measurement_noise_std_dps,
               .walk = arima.walk_dps * arima.walk_dps / interval_s};
  if (e.phi > 0.0 && arima.memory != 0.0)
    law.decaying.push_back({arima.variance(), -interval_s / std::log(e.phi)});
  for (const auto& effect : scenario.effects)
    if (const auto* cause = cause_types().find(effect.id());
        cause != nullptr && cause->enter != nullptr)
      cause->enter(effect, law);
  return law;
}

SetFitter::SetFitter(const Conditions& conditions, std::shared_ptr<const ReducedRate> reduced,
                     Interrupt interrupt, std::vector<KnownSize> known)
    : SetFitter(conditions, std::move(reduced), interrupt, std::move(known), Eigen::MatrixXd()) {}

SetFitter::SetFitter(const Conditions& conditions, std::shared_ptr<const ReducedRate> reduced,
                     Interrupt interrupt, std::vector<KnownSize> known,
                     const Eigen::MatrixXd& further)
    : conditions_(conditions),
      reduced_(std::move(reduced)),
      interrupt_(interrupt),
      known_(std::move(known)),
      further_(further) {
  further_spreads_.resize(further_.cols());
  for (Eigen::Index c = 0; c < further_.cols(); ++c) {
    auto column = further_.col(c);
    column.array() -= column.mean();
    further_spreads_[c] =
        std::max(1e-300, std::sqrt(column.squaredNorm() / static_cast<double>(column.size())));
    column /= further_spreads_[c];
  }
  slow_series_.t_s = conditions.slow_time_s();
  slow_series_.temperature_C = conditions.slow_temperature_C();
  slow_series_.gyro_dps.assign(slow_series_.size(), 0.0);
  for (const auto channel : {&Series::acc_x_mps2, &Series::acc_y_mps2, &Series::acc_z_mps2})
    if (const auto& values = conditions.series().*channel; !values.empty())
      slow_series_.*channel = conditions.slow_means(values);
  const auto& drift = conditions.drift_regressors();
  drift_ = drift.rightCols(drift.cols() - 1);
  for (Eigen::Index c = 0; c < drift_.cols(); ++c) {
    drift_spreads_.push_back(std::max(
        1e-12, std::sqrt(drift_.col(c).squaredNorm() / static_cast<double>(drift_.rows()))));
    drift_.col(c) /= drift_spreads_.back();
  }
  const auto& means = reduced_->slow(Part::train).means;
  amplitude_dps_ =
      means.size() > 1 ? std::sqrt((means.array() - means.mean()).square().mean()) : 1.0;
}

const KnownSize* SetFitter::known(const Effect& effect, std::size_t field) const {
  const auto at = std::find_if(known_.begin(), known_.end(), [&](const auto& k) {
    return k.effect == effect.id() && k.field == field;
  });
  return at == known_.end() ? nullptr : &*at;
}

/// From all samples, once: it depends on nothing that is fitted.
Eigen::VectorXd SetFitter::fixed_signature(const Scenario& alone) const {
  const auto& effect = alone.effects.front();
  std::vector<double> values;
  for (std::size_t f = 0; f < effect.fields().size(); ++f) values.push_back(effect.value(f));
  const std::scoped_lock lock(mutex_);
  auto& known = fixed_[{std::string(effect.id()), values}];
  if (known.size() == 0) {
    Series with;
    synthesise_rate_under(alone, conditions_.series(), {}, with);
    for (std::size_t i = 0; i < with.rate_ref_dps.size(); ++i)
      with.gyro_dps[i] -= with.rate_ref_dps[i];
    const auto means = conditions_.slow_means(with.gyro_dps);
    known =
        Eigen::Map<const Eigen::VectorXd>(means.data(), static_cast<Eigen::Index>(means.size()));
    for (double& value : known)
      if (is_missing(value)) value = 0.0;
  }
  return known;
}

SetFitter::Regressors SetFitter::regressors_of(const Scenario& scenario) const {
  Regressors found{drift_, drift_spreads_, std::vector<double>(drift_spreads_.size(), 0.0)};
  auto& regressors = found.columns;
  Scenario alone;
  alone.sampling = scenario.sampling;
  alone.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  alone.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  Series with;
  for (const auto& effect : scenario.effects) {
    const auto* cause = cause_types().find(effect.id());
    if (cause == nullptr || cause->signature != Signature::slow) continue;
    const bool is_fixed =
        std::all_of(cause->free_parameters.begin() + static_cast<std::ptrdiff_t>(cause->amplitudes),
                    cause->free_parameters.end(),
                    [&](auto name) { return effect.value(field_of(effect, name)) == 0.0; });
    const auto amplitudes = amplitudes_of(effect, *cause);
    for (const auto unit : amplitudes) {
      Effect one = effect;
      for (const auto field : amplitudes) one.value(field) = field == unit ? 1.0 : 0.0;
      alone.effects = {one};
      regressors.conservativeResize(static_cast<Eigen::Index>(slow_series_.size()),
                                    regressors.cols() + 1);
      auto column = regressors.col(regressors.cols() - 1);
      if (is_fixed) {
        column = fixed_signature(alone);
      } else {
        synthesise_rate_under(alone, slow_series_, {}, with);
        column = Eigen::Map<const Eigen::VectorXd>(with.gyro_dps.data(), column.size());
      }
      // In units of its own spread, so that one prior holds for all.
      const double largest = column.cwiseAbs().maxCoeff();
      column.array() -= column.mean();
      double spread = std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
      constexpr double rounding = 1e-12;
      if (!(spread > rounding * largest)) {
        column.setZero();
        spread = 0.0;
      } else {
        column /= spread;
      }
      found.spreads.push_back(spread);
      const auto* size = known(effect, unit);
      found.errors.push_back(size != nullptr ? size->error : 0.0);
    }
  }
  if (further_.cols() > 0) {
    regressors.conservativeResize(static_cast<Eigen::Index>(slow_series_.size()),
                                  regressors.cols() + further_.cols());
    regressors.rightCols(further_.cols()) = further_;
  }
  return found;
}

NoiseLaw SetFitter::law_for(const Scenario& scenario, Jumping jumping) const {
  auto law = law_of(scenario, conditions_.interval_s());
  return jumping == Jumping::yes ? law : law.without_jumps();
}

SlowTerms SetFitter::slow_terms_of(const SlowLaw& law, const Regressors& regressors,
                                   const SlowTerms* near, bool is_the_last) const {
  constexpr double drift_prior = 3.0;  // drifts are larger than what is found beside them
  Eigen::VectorXd prior_std = Eigen::VectorXd::Constant(regressors.columns.cols(), amplitude_dps_);
  prior_std.head(drift_.cols()) *= drift_prior;
  // Of a size that samples know, clusters find by how much it is another; that it was known at
  // their cost is what the samples' likelihood lacks.
  double cost = 0.0;
  for (std::size_t c = 0; c < regressors.errors.size(); ++c) {
    const double known = regressors.errors[c] * regressors.spreads[c];
    if (!(known > 0.0)) continue;
    cost += 0.5 * std::log1p(amplitude_dps_ * amplitude_dps_ / (known * known));
    prior_std[static_cast<Eigen::Index>(c)] = known;
  }
  auto terms = slow_terms(*reduced_, law, regressors.columns, prior_std, near, is_the_last);
  terms.log_likelihood -= cost;
  return terms;
}

RateTerms SetFitter::terms(const Scenario& scenario, Jumping jumping, const SlowTerms* near) const {
  interrupt_.check();
  RateTerms terms{.bands = rate_bands(*reduced_, law_for(scenario, jumping)), .slow = {}};
  terms.slow = slow_terms_of(terms.bands.slow, regressors_of(scenario), near);
  terms.log_likelihood = terms.slow.log_likelihood + terms.bands.fast.log_likelihood;
  return terms;
}

Eigen::VectorXd SetFitter::further_sizes(const Scenario& scenario) const {
  return terms(scenario, Jumping::no)
      .slow.coefficients.tail(further_.cols())
      .cwiseQuotient(further_spreads_);
}

Scenario SetFitter::with_white_noise_scaled(Scenario scenario) const {
  auto& white = scenario.random_error.measurement_noise_std_dps;
  constexpr int passes = 3;  // more than one where white noise is not all that there is
  // Where a walk has stood in for it, there is none to scale.
  white = std::max(white, 0.1 * reduced_->white_std_dps());
  for (int pass = 0; pass < passes; ++pass) {
    const double ratio = fast_ratio(*reduced_, law_of(scenario, conditions_.interval_s()));
    white *= std::sqrt(std::clamp(ratio, 0.01, 1e4));
  }
  return scenario;
}

void SetFitter::take_coefficients(const RateTerms& terms, SetFit& fit) const {
  const auto& found = terms.slow.coefficients;
  if (found.size() == 0) return;
  const auto spreads = regressors_of(fit.scenario).spreads;
  auto at = static_cast<std::size_t>(drift_.cols());
  fit.drift = found.head(drift_.cols());
  for (std::size_t c = 0; c < at; ++c) fit.drift[static_cast<Eigen::Index>(c)] /= spreads[c];
  for (auto& effect : fit.scenario.effects) {
    const auto* cause = cause_types().find(effect.id());
    if (cause == nullptr || cause->signature != Signature::slow) continue;
    for (const auto field : amplitudes_of(effect, *cause)) {
      // Of an axis along which nothing changes there is no size.
      const double size = found[static_cast<Eigen::Index>(at)];
      const auto* besides = known(effect, field);
      effect.value(field) = (besides != nullptr ? besides->size : 0.0) +
                            (spreads[at] > 0.0 ? size / spreads[at] : 0.0);
      ++at;
    }
  }
}

}  // namespace gyrostat::gap
