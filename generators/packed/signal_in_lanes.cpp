#include <gyrostat/generators/packed/signal_in_lanes.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>

#include <gyrostat/generators/random_error.hpp>

namespace gyrostat {
namespace {

bool same_bits(const Series& a, const Series& b) {
  return std::all_of(channels.begin(), channels.end(), [&](const Channel& channel) {
    const auto &x = a.*channel.values, &y = b.*channel.values;
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0);
  });
}

/// An effect on the compass that needs what differs between trials, or may: code of others.
bool looks_at_the_rate(const Effect& effect) {
  const auto& [needs, code] = std::tie(effect.type().needs, effect.type().code);
  return effect.stage() == Stage::compass &&
         (!code.empty() || std::find(needs.begin(), needs.end(), &Series::gyro_dps) != needs.end());
}

/// All that comes before the noise of gyro and compass.
void make_shared(const Scenario& scenario, const Noise& noise, Series& series) {
  synthesise_conditions(scenario, noise, series);
  turn_compass(scenario, noise, series);
}

}  // namespace

std::optional<SharedConditions> shared_conditions(const Scenario& scenario) {
  if (scenario.recorded_noise_dps) return std::nullopt;
  SharedConditions shared;
  shared.on_gyro = effects_on_gyro(scenario);
  if (!std::all_of(shared.on_gyro.begin(), shared.on_gyro.end(),
                   [](const Effect& effect) { return effect.is_sample_by_sample(); }))
    return std::nullopt;
  if (std::any_of(scenario.effects.begin(), scenario.effects.end(), looks_at_the_rate))
    return std::nullopt;
  auto& series = shared.series;
  NoiseTape tape;
  make_shared(scenario, {.seed = 1, .trial = 0, .tape = &tape}, series);
  if (!tape.empty()) return std::nullopt;
  if (!scenario.effects.empty()) {  // one might look at the trial's number itself
    Series other;
    make_shared(scenario, {.seed = 2, .trial = 1}, other);
    if (!same_bits(series, other)) return std::nullopt;
  }
  for (std::size_t i = 0; i < series.size(); ++i)
    shared.steady_dps.push_back(series.rate_ref_dps[i] + series.thermal_bias_dps[i]);
  series.mag_valid = scenario.compass.valid(series.t_s);
  return shared;
}

bool SignalInLanes::can_draw(std::span<const Noise> trials) {
  return std::all_of(trials.begin(), trials.end(), [&](const Noise& noise) {
    return noise.shares.empty() && noise.tape == nullptr && noise.seed == trials.front().seed;
  });
}

SignalInLanes::SignalInLanes(const Scenario& scenario, const SharedConditions& conditions,
                             std::span<const Noise> trials, const SignalKernel& kernel)
    : conditions_(conditions), kernel_(kernel) {
  const auto seed = trials.front().seed;
  const auto& model = scenario.random_error;
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  for (std::size_t l = 0; l < lanes; ++l) {
    const Noise& noise = trials[std::min(l, trials.size() - 1)];
    trials_.push_back(noise.trial);
    first_difference_dps_.push_back(unexplained_difference_dps(model) *
                                    noise.stream("random_error/initial").normal(0));
  }
  state_.resize(3 * lanes);
  gyro_ = {.model = model,
           .random_error = address_of(seed, "random_error"),
           .white_noise = address_of(seed, "white_noise"),
           .trials = trials_.data(),
           .first_difference_dps = first_difference_dps_.data(),
           .state = state_.data()};
  for (std::size_t n = 0; n < scenario.compass.disturbances.size(); ++n)
    disturbances_.push_back({scenario.compass.disturbances[n],
                             address_of(seed, "compass/disturbance/" + std::to_string(n))});
  compass_ = {.noise_std_deg = scenario.compass.noise_std_deg,
              .white_noise = address_of(seed, "compass"),
              .trials = trials_.data(),
              .disturbances = disturbances_};
}

void SignalInLanes::gyro(std::size_t first, std::size_t samples, double* gyro_dps,
                         double* random_error_dps) {
  kernel_.gyro(gyro_, first, samples, conditions_.steady_dps.data() + first, gyro_dps,
               random_error_dps);
  if (!conditions_.on_gyro.empty()) apply_effects(first, samples, gyro_dps);
}

void SignalInLanes::apply_effects(std::size_t first, std::size_t samples, double* gyro_dps) {
  const std::size_t all = samples * static_cast<std::size_t>(kernel_.lanes);
  const auto make = [&](std::vector<double> Series::*channel) {
    const auto& from = conditions_.series.*channel;
    if (channel == &Series::gyro_dps || from.empty()) return;
    (stretch_.*channel).resize(all);
    spread(from, first, samples, (stretch_.*channel).data());
  };
  make(&Series::t_s);
  for (const auto& effect : conditions_.on_gyro)
    for (const auto channel : effect.type().needs) make(channel);
  stretch_.gyro_dps.assign(gyro_dps, gyro_dps + all);
  apply_in_order(conditions_.on_gyro, {}, stretch_);
  std::copy(stretch_.gyro_dps.begin(), stretch_.gyro_dps.end(), gyro_dps);
}

void SignalInLanes::heading(std::size_t first, std::size_t samples, double* heading_deg) const {
  kernel_.heading(compass_, first, samples, conditions_.series.t_s.data() + first,
                  conditions_.series.heading_deg.data() + first, heading_deg);
}

}  // namespace gyrostat
