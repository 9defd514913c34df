#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/block_level.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/felt_acceleration.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {
namespace {

std::ptrdiff_t missing_in(const std::vector<double>& values) {
  return std::count_if(values.begin(), values.end(), [](double v) { return is_missing(v); });
}

}  // namespace

bool has(const Scenario& scenario, std::string_view effect) {
  return std::any_of(scenario.effects.begin(), scenario.effects.end(),
                     [&](const auto& e) { return e.id() == effect; });
}

bool is_taken_out(const Effect& effect) {
  const auto* cause = cause_types().find(effect.id());
  return cause != nullptr && cause->signature == Signature::repeated &&
         effect.stage() != Stage::compass;
}

SetBench::SetBench(const Simulator& simulator, const Series& recording,
                   std::vector<std::string> without)
    : simulator_(simulator),
      conditions_(simulator.conditions()),
      recording_(recording),
      without_(std::move(without)),
      is_shaken_(is_shaken(conditions_)) {
  mask_only(std::vector<char>(recording.size(), 0));
  missing_ = missing_in(rate_error_beside(plain()));
}

bool SetBench::is_allowed(std::string_view effect) const {
  if (std::find(without_.begin(), without_.end(), effect) != without_.end()) return false;
  const auto* cause = cause_types().find(effect);
  return cause != nullptr && cause->why_not_assessable(conditions_).empty();
}

bool SetBench::is_given(std::string_view effect) const {
  return std::find(given_.begin(), given_.end(), effect) != given_.end();
}

bool SetBench::is_marked(std::string_view effect) const {
  return is_given(effect) || (marked_saturation_ && effect == "saturation") ||
         (marked_dead_zone_ && effect == "dead_zone") || effect == "quantization" ||
         effect == "stale_samples" || effect == "outliers" || effect == "noise_temperature";
}

void SetBench::mask_only(std::vector<char> samples) {
  grid_ = std::make_shared<const RateGrid>(conditions_, std::move(samples));
}

void SetBench::mask_too(const std::vector<char>& samples) {
  auto masked = grid_->counted().masked();
  for (std::size_t i = 0; i < masked.size(); ++i)
    if (samples[i] != 0) masked[i] = 1;
  mask_only(std::move(masked));
}

Scenario SetBench::plain() const {
  Scenario s;
  s.sampling.duration_s = conditions_.interval_s() * static_cast<double>(conditions_.size());
  s.sampling.rate_hz = conditions_.rate_hz();
  s.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  s.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  s.compass.noise_std_deg = 0.0;
  return s;
}

std::vector<double> SetBench::added_by(const std::vector<Effect>& effects) const {
  auto added = simulator_.response().of(effects);
  const auto& still = simulator_.response().still();
  for (std::size_t i = 0; i < added.size(); ++i) added[i] -= still[i];
  return added;
}

std::vector<double> SetBench::gyro_as_felt(const Scenario& scenario) const {
  auto gyro = recording_.gyro_dps;
  std::vector<Effect> taken_out;
  for (const auto& effect : scenario.effects)
    if (is_taken_out(effect)) taken_out.push_back(effect);
  if (response_) taken_out.push_back(*response_);
  if (taken_out.empty()) return gyro;
  const auto added = added_by(taken_out);
  for (std::size_t i = 0; i < gyro.size(); ++i) gyro[i] -= added[i];
  return gyro;
}

std::vector<double> SetBench::sensed_rate(const Scenario& scenario) const {
  auto rate = conditions_.series().rate_ref_dps;
  std::vector<Effect> responses;
  for (const auto& effect : scenario.effects)
    if (effect.is_response()) responses.push_back(effect);
  const auto added = added_by(responses);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] += added[i];
  return rate;
}

std::vector<double> SetBench::error_of(std::vector<double> gyro) const {
  const auto& reference = conditions_.series().rate_ref_dps;
  for (std::size_t i = 0; i < reference.size(); ++i) gyro[i] -= reference[i];
  return gyro;
}

std::vector<double> SetBench::gyro_beside(const Scenario& scenario) const {
  auto gyro = gyro_as_felt(scenario);
  const auto felt = felt_under(scenario, error_of(gyro)).of_samples;
  for (std::size_t i = 0; i < felt.size(); ++i) gyro[i] -= felt[i];
  return gyro;
}

std::vector<double> SetBench::rate_error_beside(const Scenario& scenario) const {
  auto error = error_of(gyro_beside(scenario));
  conditions_.bridge(error);
  return error;
}

std::shared_ptr<const SetFitter> SetBench::fitter_of(const Scenario& scenario) const {
  simulator_.interrupt().check();
  auto error = error_of(gyro_as_felt(scenario));
  auto felt = felt_under(scenario, error);
  for (std::size_t i = 0; i < felt.of_samples.size(); ++i) error[i] -= felt.of_samples[i];
  for (std::size_t i = 0; i < felt.of_means.size(); ++i)
    if (masked()[i] != 0) felt.of_means[i] = no_value;
  conditions_.bridge(error);
  // Likelihoods of other samples are not to be compared.
  constexpr double most_lost = 0.01;
  if (static_cast<double>(missing_in(error) - missing_) >
      most_lost * static_cast<double>(error.size()))
    return nullptr;
  return std::make_shared<SetFitter>(
      conditions_,
      std::make_shared<const ReducedRate>(
          conditions_, std::move(error), grid_,
          felt.of_means.empty() ? std::vector<double>{} : conditions_.slow_means(felt.of_means)),
      simulator_.interrupt(), std::move(felt.known));
}

Standing SetBench::fitted(const Scenario& scenario, std::shared_ptr<const SetFitter> fitter,
                          int iterations, Jumping jumping) const {
  // Not one initialiser beside others: where it throws, GCC 12 -O3 destroys those before it twice.
  Standing s;
  if (!fitter) return s;
  s.fit = fitter->maximise(scenario, iterations, jumping, [&](const Dial& dial) {
    return is_given(dial.of) && is_alike(scenario.effects[dial.place->effect], dial.place->field);
  });
  s.fitter = std::move(fitter);
  s.scenario = s.fit.scenario;
  s.score = s.fit.log_likelihood - price_of(s.scenario);
  if (std::isnan(s.score)) s.score = Standing{}.score;
  return s;
}

Evidence SetBench::evidence_of(const Standing& standing) const {
  Series left = recording_;
  left.gyro_dps = gyro_beside(standing.scenario);
  Evidence evidence{simulator_, recording_, Scene(conditions_, left), standing.scenario};
  evidence.hidden = masked();
  evidence.nyquist_hz = grid().nyquist_hz();
  auto counted = evidence.scene.rate_error_dps;
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (evidence.hidden[i] != 0) counted[i] = no_value;
  evidence.level_gain = level_gain_of(conditions_, counted);
  // A further effect sees the rate as those have it sensed.
  std::erase_if(evidence.baseline.effects, [](const auto& e) { return !e.is_response(); });
  if (response_) evidence.baseline.effects.push_back(*response_);
  take_undisturbed(evidence, Trace::rate);
  const auto& points = standing.fitter->reduced().slow(Part::train).points;
  const auto innovations =
      standing.fitter->terms(standing.fit.scenario, Jumping::no).slow.innovations;
  evidence.slow_innovations.assign(conditions_.slow_size(), 0.0);
  for (std::size_t k = 0; k < innovations.size(); ++k)  // there is none of the first
    evidence.slow_innovations[points[k + 1]] = innovations[k];
  return evidence;
}

std::vector<double> SetBench::known_rate(const Scenario& scenario) const {
  const auto error = error_of(gyro_beside(scenario));
  auto known = recording_.gyro_dps;
  for (std::size_t i = 0; i < known.size(); ++i) known[i] -= error[i];
  return known;
}

std::vector<double> SetBench::rate_left_by(const Scenario& scenario,
                                           const std::vector<char>& hidden) const {
  auto left = rate_error_beside(scenario);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (hidden[i] != 0) left[i] = no_value;
  take_out_level(conditions_, left);
  return left;
}

}  // namespace gyrostat::gap
