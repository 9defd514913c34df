#include <gyrostat/diagnosis/compare/trace_study.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/compare/counted.hpp>
#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/likelihood/tails.hpp>

namespace gyrostat::gap {

TraceStudy::TraceStudy(const Series& trace, std::uint64_t seed, std::vector<std::string> without,
                       const Interrupt& interrupt, const SetSearchProgress& progress)
    : series_(trace),
      without_(std::move(without)),
      simulator_(std::make_unique<Simulator>(series_, seed, interrupt)),
      found_(find_set(*simulator_, series_, {.without = without_}, progress)) {}

std::vector<Effect> TraceStudy::effects(std::string_view name) const {
  std::vector<Effect> named;
  for (const auto& effect : found_.scenario.effects)
    if (effect.id() == name) named.push_back(effect);
  return named;
}

double TraceStudy::log_odds(std::string_view name) const {
  for (const auto& member : found_.members)
    if (member.effect == name) return std::max(0.0, member.log_odds);
  return 0.0;
}

std::vector<double> TraceStudy::error_dps(std::vector<double> error, double resolution_dps) const {
  if (resolution_dps > 0.0)
    for (double& z : error) z = resolution_dps * std::nearbyint(z / resolution_dps);
  const auto& c = conditions();
  const auto& reference = c.series().rate_ref_dps;
  for (std::size_t i = 0; i < reference.size(); ++i) error[i] -= reference[i];
  if (c.drift_regressors().cols() == 1) return error;
  auto slow = c.slow_means(error);
  double last = 0.0;
  for (double& value : slow) value = last = is_missing(value) ? last : value;
  auto coefficients = c.drift_of(slow);
  coefficients[0] = 0.0;
  const auto drift = c.drift(coefficients);
  for (std::size_t i = 0; i < error.size() && !drift.empty(); ++i) {
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(c.cluster()) - 0.5;
    const auto low = static_cast<std::size_t>(
        std::clamp(std::floor(at), 0.0, static_cast<double>(drift.size() - 1)));
    const auto high = std::min(low + 1, drift.size() - 1);
    const double share = std::clamp(at - static_cast<double>(low), 0.0, 1.0);
    error[i] -= drift[low] + share * (drift[high] - drift[low]);
  }
  return error;
}

Series TraceStudy::mended(const Addition& addition, const Noise& noise) const {
  std::vector<Effect> later;
  for (const auto& effect : found_.scenario.effects)
    if (effect.stage() == Stage::conversion) later.push_back(effect);
  auto with = with_added(series_, addition, later, simulator_->resolution_dps(), noise);
  if (has(found_.scenario, "stale_samples"))
    for (std::size_t i = 1; i < with.size(); ++i)
      if (series_.gyro_dps[i] == series_.gyro_dps[i - 1]) with.gyro_dps[i] = with.gyro_dps[i - 1];
  return with;
}

/// The bench with the samples hidden that the search did not count, and the set fitted on it.
void TraceStudy::prepare() const {
  if (bench_) return;
  bench_ = std::make_unique<SetBench>(*simulator_, series_, without_);
  const auto& set = found_.scenario;
  const bool repeats = has(set, "stale_samples"), clipped = has(set, "saturation");
  if (repeats || clipped) {
    const auto marks = marks_of(*simulator_, series_);
    if (repeats && !marks.repeats.empty()) bench_->mask_too(marks.repeats);
    if (clipped && !marks.clipped.empty()) bench_->mask_too(marks.clipped);
  }
  const bool outliers = std::any_of(set.effects.begin(), set.effects.end(), [](const auto& e) {
    return e.id() == "outliers" && e.stage() != Stage::noise;  // behind filters
  });
  if (outliers) {
    const auto left = bench_->rate_left_by(set, bench_->masked());
    bench_->mask_too(tails_of(conditions(), left, conditions().has_temperature()).outliers);
  }
  Scenario rate = set;
  std::erase_if(rate.effects, [](const auto& e) { return e.stage() == Stage::compass; });
  standing_ = bench_->refitted(rate);
}

double TraceStudy::best_likelihood(const Scenario& scenario, std::string_view held) const {
  constexpr int iterations = 15;
  const bool takes_out = std::any_of(scenario.effects.begin(), scenario.effects.end(),
                                     [](const auto& effect) { return is_taken_out(effect); });
  const auto fitter = takes_out ? bench_->refitted(scenario, 0).fitter : standing_.fitter;
  return fitter
      ->maximise(scenario, iterations, Jumping::yes,
                 [&](const Dial& dial) { return dial.of == held; })
      .log_likelihood;
}

double TraceStudy::worth(std::string_view name) const {
  prepare();
  const auto& effects = standing_.scenario.effects;
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (effects[k].id() == name)
      return std::max(0.0, standing_.score - bench_->without(standing_, k).score);
  return 0.0;
}

void TraceStudy::allow(std::vector<Effect> effects) {
  allowed_ = std::move(effects);
  free_likelihood_.reset();
}

double TraceStudy::best_allowed(const Scenario& scenario, std::string_view held) const {
  const double alone = best_likelihood(scenario, held);
  Scenario more = scenario;
  for (const auto& effect : allowed_)
    if (effect.id() != held) more.effects.push_back(effect);
  if (more.effects.size() == scenario.effects.size()) return alone;
  return std::max(alone, best_likelihood(more, held));
}

double TraceStudy::loss_of(const Scenario& other, std::string_view held) const {
  if (!free_likelihood_) free_likelihood_ = best_allowed(standing_.scenario, {});
  return std::max(0.0, *free_likelihood_ - best_allowed(other, held));
}

double TraceStudy::loss_with(std::string_view name, const std::vector<Effect>& others) const {
  prepare();
  const auto* cause = cause_types().find(name);
  if (cause == nullptr || cause->signature == Signature::slow ||
      (cause->enter == nullptr && cause->signature != Signature::repeated))
    return 0.0;
  Scenario other = standing_.scenario;
  std::erase_if(other.effects, [&](const auto& e) { return e.id() == name; });
  for (const auto& effect : others) other.effects.push_back(effect);
  return loss_of(other, name);
}

double TraceStudy::loss_with_white(double std_dps) const {
  prepare();
  Scenario other = standing_.scenario;
  other.random_error.measurement_noise_std_dps = std_dps;
  return loss_of(other, white_noise);
}

double TraceStudy::loss_with_walk(double dps_per_sqrt_s) const {
  prepare();
  Scenario other = standing_.scenario;
  other.random_error.delta1_dps = dps_per_sqrt_s * std::sqrt(conditions().interval_s());
  return loss_of(other, random_walk);
}

std::vector<double> TraceStudy::errors_of(std::string_view name) const {
  constexpr double two_sided_95 = 1.959964;
  const auto& all = found_.scenario.effects;
  const auto at = static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.id() == name; }) -
      all.begin());
  if (at == all.size()) return {};
  auto errors = errors_by_count(all[at], conditions());
  for (const auto& interval : found_.intervals)
    if (interval.effect == at)
      errors[interval.field] = (interval.high - interval.low) / (2.0 * two_sided_95);
  return errors;
}

bool TraceStudy::has_memory() const {
  prepare();
  const auto& error = standing_.scenario.random_error;
  return error.phi != 0.0 || error.delta2_dps != 0.0;
}

double TraceStudy::white_std_dps() const {
  prepare();
  return standing_.scenario.random_error.measurement_noise_std_dps;
}

double TraceStudy::walk_dps_per_sqrt_s() const {
  prepare();
  return standing_.scenario.random_error.delta1_dps / std::sqrt(conditions().interval_s());
}

}  // namespace gyrostat::gap
