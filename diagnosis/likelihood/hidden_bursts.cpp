#include <gyrostat/diagnosis/likelihood/hidden_bursts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/block_powers.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/on_and_off.hpp>
#include <gyrostat/diagnosis/likelihood/two_exponentials.hpp>
#include <gyrostat/generators/effects/vibration_bursts.hpp>

namespace gyrostat::gap {
namespace {

/// The powers of a bin, and what two means gain on one, where they are clearly two.
struct Mixture {
  TwoExponentials means{};
  double gain = 0.0;
};
Mixture mixture_of(const BlockPowers& powers, std::size_t bin) {
  constexpr int passes = 40;
  constexpr double most_on = 0.5, clearly_more = 3.0;
  std::vector<double> values;
  for (const auto& span : powers.spans)
    for (const auto& block : span)
      if (!block.empty()) values.push_back(block[bin]);
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  const auto means = two_exponentials(values, {0.02, 6.0 * mean, 0.9 * mean}, most_on, passes);
  const bool are_two = means.on > clearly_more * means.off;
  return {means, are_two ? means.log_likelihood(values) + n * (std::log(mean) + 1.0) : 0.0};
}

/// How the bin comes and goes; blocks of which too little is known say nothing.
OnAndOff course_of(const BlockPowers& powers, std::size_t bin, const TwoExponentials& means) {
  std::vector<std::vector<double>> stretches;
  for (const auto& span : powers.spans) {
    stretches.emplace_back();
    for (const auto& block : span)
      stretches.back().push_back(block.empty() ? no_value : block[bin]);
  }
  return on_and_off(stretches, OnAndOff::in_any_order(means, 1.0));
}

}  // namespace

std::optional<HiddenLine> hidden_bursts(const SetBench& bench, const Scenario& set,
                                        const std::vector<double>& left_dps, double clear) {
  const auto& conditions = bench.conditions();
  // What is left of a motion comes and goes as it does.
  if (!conditions.series().rate_ref_dps.empty()) return std::nullopt;
  const auto noise = law_of(set, conditions.interval_s());
  const auto& cause = cause_types().named("vibration_bursts", "effects");
  Scenario with = set;
  with.effects.push_back(cause.effect());
  const double price = bench.price_of(with) - bench.price_of(set);
  std::optional<HiddenLine> best;
  constexpr std::array block_s = {0.5, 1.0, 2.0, 4.0};
  constexpr std::size_t fewest_samples = 16, fewest_blocks = 50, apart = 3, furthest = 6,
                        lowest = 8;
  for (const double seconds : block_s) {
    const auto length = static_cast<std::size_t>(std::lround(seconds * conditions.rate_hz()));
    if (length < fewest_samples) continue;
    const double half_hz = 0.5 * bench.grid().nyquist_hz();
    const auto powers = block_powers(conditions, left_dps, noise, length, half_hz, half_hz);
    if (powers.told() < fewest_blocks || powers.bins() < lowest + 2 * furthest) continue;
    std::vector<Mixture> mixtures(powers.bins());
    tbb::parallel_for(std::size_t{0}, mixtures.size(),
                      [&](std::size_t k) { mixtures[k] = mixture_of(powers, k); });
    const double places = std::log(static_cast<double>(block_s.size() * mixtures.size()));
    for (std::size_t k = lowest; k + furthest < mixtures.size(); ++k) {
      const auto& [means, gain] = mixtures[k];
      // What comes and goes in a wide band, as the flips of a grid, does so in others, too.
      double beside = 0.0;
      for (std::size_t by = apart; by <= furthest; ++by)
        beside = std::max({beside, mixtures[k - by].gain, mixtures[k + by].gain});
      const double log_odds = gain - std::max(price, 2.0 * beside) - places;
      if (log_odds < clear || (best && log_odds <= best->log_odds)) continue;
      const auto course = course_of(powers, k, means);
      const Effect bursts = effects::VibrationBursts{
          .std_dps = std::sqrt(2.0 * powers.noise_dps2[k] * (course.on - course.off) /
                               static_cast<double>(length)),
          .centre_hz = powers.resolution_hz * static_cast<double>(powers.first + k),
          .bandwidth_hz = powers.resolution_hz,
          .mean_duration_s = 1.01 * powers.interval_s / course.ends,  // a block, at least
          .mean_interval_s = powers.interval_s / course.begins};
      const Resonance band = band_of_line(bursts);
      const auto is_beside = [&](const Effect& effect) {
        return is_line(effect.id()) && are_neighbours(band_of_line(effect), band);
      };
      if (cause.is_what_it_is_called(bursts, conditions) &&
          std::none_of(set.effects.begin(), set.effects.end(), is_beside))
        best = HiddenLine{bursts, log_odds};
    }
  }
  return best;
}

}  // namespace gyrostat::gap
