#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/arima_law.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

/// The innovation of the decaying error beside the walk, as a share of the white noise.
Dial size_of_memory(double white) {
  return {[=](const Scenario& s) { return ArimaLaw::of(s.random_error).memory / (white * white); },
          [=](Scenario& s, double x) {
            auto law = ArimaLaw::of(s.random_error);
            const double from_walk = law.walk_dps * (1.0 + law.phi);
            law.memory = std::max(x * white * white, -0.25 * from_walk * from_walk);
            law.put(s.random_error);
          },
          0.5};
}

Dial length_of_memory() {
  return {[](const Scenario& s) { return std::atanh(s.random_error.phi); },
          [](Scenario& s, double x) {
            auto law = ArimaLaw::of(s.random_error);
            constexpr double longest = 0.967;  // beyond, it is a slow error
            law.phi = std::clamp(std::tanh(x), 0.05, longest);
            law.put(s.random_error);
          },
          0.5};
}

std::vector<Dial> dials_of(const Scenario& scenario) {
  std::vector<Dial> dials;
  const double white = scenario.random_error.measurement_noise_std_dps;
  dials.push_back(
      logarithmic([](Scenario& s) -> double& { return s.random_error.measurement_noise_std_dps; },
                  1e-6 * white, 1e6 * white));
  dials.back().of = white_noise;
  dials.push_back(size_of_walk(1e-9 * white, 1e3 * white));
  dials.back().of = random_walk;
  if (scenario.random_error.phi != 0.0) {
    dials.push_back(size_of_memory(white));
    dials.push_back(length_of_memory());
  }
  for (std::size_t k = 0; k < scenario.effects.size(); ++k) {
    const auto& effect = scenario.effects[k];
    const auto& cause = cause_types().named(effect.id(), "effects");
    if (cause.enter == nullptr && cause.signature != Signature::slow) continue;
    const auto amplitudes = cause.signature == Signature::slow ? cause.amplitudes : 0;
    for (std::size_t f = 0; f < effect.fields().size(); ++f) {
      const auto& field = effect.fields()[f];
      if (std::find(cause.free_parameters.begin() + static_cast<std::ptrdiff_t>(amplitudes),
                    cause.free_parameters.end(), field.name) == cause.free_parameters.end())
        continue;
      const auto value = [k, f](Scenario& s) -> double& { return s.effects[k].value(f); };
      const double start = effect.value(f);
      double largest = 1e-12;
      for (std::size_t g = 0; g < effect.fields().size(); ++g)
        if (effect.fields()[g].unit == field.unit)
          largest = std::max(largest, std::abs(effect.value(g)));
      if (field.range.from >= 0.0 && start > 0.0)
        dials.push_back(logarithmic(value, std::max(field.range.from, 1e-3 * start),
                                    std::min(field.range.to, 1e3 * start)));
      else
        dials.push_back(linear(value, largest));
      dials.back().place = Dial::Place{k, f};
      dials.back().of = cause.id;
    }
  }
  return dials;
}

}  // namespace

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
                     Interrupt interrupt)
    : SetFitter(conditions, std::move(reduced), interrupt, Eigen::MatrixXd()) {}

SetFitter::SetFitter(const Conditions& conditions, std::shared_ptr<const ReducedRate> reduced,
                     Interrupt interrupt, const Eigen::MatrixXd& further)
    : conditions_(conditions),
      reduced_(std::move(reduced)),
      interrupt_(interrupt),
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
  Regressors found{drift_, drift_spreads_};
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
    const bool is_fixed = cause->free_parameters.size() == cause->amplitudes;
    for (std::size_t unit = 0; unit < cause->amplitudes; ++unit) {
      Effect one = effect;
      for (std::size_t a = 0; a < cause->amplitudes; ++a)
        one.value(field_of(one, cause->free_parameters[a])) = a == unit ? 1.0 : 0.0;
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
      column.array() -= column.mean();
      const double spread = std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
      column /= std::max(spread, 1e-300);
      found.spreads.push_back(spread);
    }
  }
  if (further_.cols() > 0) {
    regressors.conservativeResize(static_cast<Eigen::Index>(slow_series_.size()),
                                  regressors.cols() + further_.cols());
    regressors.rightCols(further_.cols()) = further_;
  }
  return found;
}

RateTerms SetFitter::terms_with(const Scenario& scenario, const Regressors& regressors,
                                Jumping jumping) const {
  const auto law = law_of(scenario, conditions_.interval_s());
  constexpr double drift_prior = 3.0;  // drifts are larger than what is found beside them
  Eigen::VectorXd prior_std = Eigen::VectorXd::Constant(regressors.columns.cols(), amplitude_dps_);
  prior_std.head(drift_.cols()) *= drift_prior;
  return rate_terms(*reduced_, jumping == Jumping::yes ? law : law.without_jumps(),
                    regressors.columns, prior_std);
}

RateTerms SetFitter::terms(const Scenario& scenario, Jumping jumping) const {
  interrupt_.check();
  return terms_with(scenario, regressors_of(scenario), jumping);
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
    for (std::size_t a = 0; a < cause->amplitudes; ++a, ++at)
      effect.value(field_of(effect, cause->free_parameters[a])) =
          found[static_cast<Eigen::Index>(at)] / spreads[at];
  }
}

Eigen::MatrixXd SetFitter::slopes_of(const Scenario& scenario, const std::vector<Dial>& dials,
                                     const RateTerms& here, Jumping jumping,
                                     Eigen::VectorXd* gradient) const {
  constexpr double step = 1e-3;
  const auto count = static_cast<Eigen::Index>(dials.size());
  const auto rows = static_cast<Eigen::Index>(here.slow.innovations.size());
  const auto bins = static_cast<Eigen::Index>(here.log_density.size());
  Eigen::MatrixXd slopes(2 * rows + bins, count);
  const double root = std::sqrt(reduced_->degrees());
  tbb::parallel_for(Eigen::Index{0}, count, [&](Eigen::Index d) {
    const auto there =
        terms(moved(scenario, dials, step * Eigen::VectorXd::Unit(count, d)), jumping);
    if (gradient != nullptr) (*gradient)[d] = (there.log_likelihood - here.log_likelihood) / step;
    for (Eigen::Index k = 0; k < rows; ++k) {
      const auto i = static_cast<std::size_t>(k);
      slopes(k, d) =
          std::sqrt(0.5) * (there.slow.log_variances[i] - here.slow.log_variances[i]) / step;
      slopes(rows + k, d) = (there.slow.innovations[i] - here.slow.innovations[i]) / step;
    }
    for (Eigen::Index k = 0; k < bins; ++k) {
      const auto i = static_cast<std::size_t>(k);
      slopes(2 * rows + k, d) = root * (there.log_density[i] - here.log_density[i]) / step;
    }
  });
  return slopes;
}

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
      at += cause->amplitudes;
  const double spread = regressors_of(scenario).spreads[at];
  const auto errors = coefficients_over_walks(scenario).second;
  return {errors[static_cast<Eigen::Index>(at)] / spread, amplitude_dps_ / spread};
}

std::vector<ParameterInterval> SetFitter::intervals(const SetFit& fit) const {
  constexpr double two_sided_95 = 1.959964;
  std::vector<ParameterInterval> found;
  const auto dials = dials_of(fit.scenario);
  const auto here = terms(fit.scenario, Jumping::no);
  const auto slopes = slopes_of(fit.scenario, dials, here, Jumping::no, nullptr);
  Eigen::MatrixXd information = slopes.transpose() * slopes;
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
    for (std::size_t a = 0; a < cause->amplitudes; ++a, ++at) {
      const auto c = static_cast<Eigen::Index>(at);
      const double value = coefficients[c] / spreads[at];
      const double reach = two_sided_95 * coefficients_std[c] / spreads[at];
      found.push_back(
          {k, field_of(effect, cause->free_parameters[a]), value - reach, value + reach});
    }
  }
  return found;
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
