#include <gyrostat/diagnosis/compare/trace_study.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
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
  if (has(set, "outliers")) {
    const auto left = bench_->rate_left_by(set, bench_->masked());
    bench_->mask_too(tails_of(conditions(), left, conditions().has_temperature()).outliers);
  }
  Scenario rate = set;
  std::erase_if(rate.effects, [](const auto& e) { return e.stage() == Stage::compass; });
  standing_ = bench_->refitted(rate);
}

/// By golden sections in the logarithms of what is free, in turn.
double TraceStudy::best_likelihood(Scenario scenario, Free free) const {
  auto& noise = scenario.random_error;
  const bool refit_signatures =
      std::any_of(scenario.effects.begin(), scenario.effects.end(), [](const auto& effect) {
        const auto* cause = cause_types().find(effect.id());
        return cause != nullptr && cause->signature == Signature::repeated;
      });
  const auto fitter = refit_signatures ? bench_->refitted(scenario, 0).fitter : standing_.fitter;
  const auto likelihood = [&] { return fitter->terms(scenario, Part::train).log_likelihood; };
  const auto improve = [&](double& value, double reach) {
    constexpr double section = 0.6180339887498949;
    if (!(value > 0.0)) return likelihood();
    double low = std::log(value) - reach, high = std::log(value) + reach;
    const auto at = [&](double x) {
      value = std::exp(x);
      return likelihood();
    };
    double a = high - section * (high - low), b = low + section * (high - low);
    double fa = at(a), fb = at(b);
    for (int k = 0; k < 14; ++k) {
      if (fa > fb) {
        high = b, b = a, fb = fa;
        fa = at(a = high - section * (high - low));
      } else {
        low = a, a = b, fa = fb;
        fb = at(b = low + section * (high - low));
      }
    }
    return at(0.5 * (low + high));
  };
  double best = likelihood();
  for (int pass = 0; pass < 2; ++pass) {
    const double near = pass == 0 ? 1.0 : 0.1;
    if (free != Free::walk) best = std::max(best, improve(noise.measurement_noise_std_dps, near));
    if (free != Free::white) best = std::max(best, improve(noise.delta1_dps, 3.0 * near));
  }
  return best;
}

double TraceStudy::loss_with(std::string_view name, const std::vector<Effect>& others) const {
  prepare();
  const auto* cause = cause_types().find(name);
  if (cause == nullptr || cause->signature == Signature::slow ||
      (cause->enter == nullptr && cause->signature != Signature::repeated))
    return 0.0;
  const double here = best_likelihood(standing_.scenario, Free::both);
  Scenario other = standing_.scenario;
  std::erase_if(other.effects, [&](const auto& e) { return e.id() == name; });
  for (const auto& effect : others) other.effects.push_back(effect);
  return std::max(0.0, here - best_likelihood(other, Free::both));
}

double TraceStudy::loss_with_white(double std_dps) const {
  prepare();
  const double here = best_likelihood(standing_.scenario, Free::both);
  Scenario other = standing_.scenario;
  other.random_error.measurement_noise_std_dps = std_dps;
  return std::max(0.0, here - best_likelihood(other, Free::walk));
}

double TraceStudy::loss_with_walk(double dps_per_sqrt_s) const {
  prepare();
  const double here = best_likelihood(standing_.scenario, Free::both);
  Scenario other = standing_.scenario;
  other.random_error.delta1_dps = dps_per_sqrt_s * std::sqrt(conditions().interval_s());
  return std::max(0.0, here - best_likelihood(other, Free::white));
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
