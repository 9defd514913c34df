#include <gyrostat/diagnosis/likelihood/hidden_bursts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/likelihood/block_powers.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

namespace gyrostat::gap {
namespace {

/// Of powers that are exponential about one of two means.
struct Mixture {
  double gain = 0.0;  ///< log-likelihood beyond one mean
  double share_on = 0.0, on = 0.0, off = 0.0;
};

/// By expectation-maximisation (Dempster, Laird and Rubin, J. R. Stat. Soc. B 39, 1977).
Mixture mixture_of(const std::vector<double>& powers) {
  constexpr int passes = 40;
  constexpr double clearly_more = 3.0;
  const auto n = static_cast<double>(powers.size());
  const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) / n;
  Mixture m{.share_on = 0.02, .on = 6.0 * mean, .off = 0.9 * mean};
  double log_likelihood = 0.0;
  for (int pass = 0; pass < passes; ++pass) {
    double weight = 0.0, of_on = 0.0, of_off = 0.0;
    log_likelihood = 0.0;
    for (const double q : powers) {
      const double on = m.share_on / m.on * std::exp(-q / m.on);
      const double all = on + (1.0 - m.share_on) / m.off * std::exp(-q / m.off) + 1e-300;
      weight += on / all;
      of_on += on / all * q;
      of_off += (1.0 - on / all) * q;
      log_likelihood += std::log(all);
    }
    m.share_on = std::clamp(weight / n, 1e-4, 0.5);
    m.on = of_on / std::max(weight, 1e-9);
    m.off = std::max(of_off / std::max(n - weight, 1e-9), 1e-6 * mean);
  }
  if (m.on > clearly_more * m.off) m.gain = log_likelihood + n * (std::log(mean) + 1.0);
  return m;
}

/// Of blocks in which a bin has more than the limit: how long they last, and how long they do not.
struct Course {
  double on_s, off_s;
};
Course course_of(const BlockPowers& powers, std::size_t bin, double limit) {
  double begun = 0.0, with = 0.0, all = 0.0;
  for (const auto& span : powers.spans) {
    bool was_on = false;
    for (const auto& block : span) {
      const bool is_on = !block.empty() && block[bin] > limit;
      begun += is_on && !was_on ? 1.0 : 0.0;
      with += is_on ? 1.0 : 0.0;
      all += 1.0;
      was_on = is_on;
    }
  }
  begun = std::max(begun, 1.0);
  return {with / begun * powers.interval_s, (all - with) / begun * powers.interval_s};
}

}  // namespace

std::optional<HiddenBursts> hidden_bursts(const SetBench& bench, const Scenario& set,
                                          const std::vector<double>& left_dps, double clear) {
  const auto& conditions = bench.conditions();
  // What is left of a motion comes and goes as it does.
  if (!conditions.series().rate_ref_dps.empty()) return std::nullopt;
  const auto noise = law_of(set, conditions.interval_s());
  const auto& cause = cause_types().named("vibration_bursts", "effects");
  Scenario with = set;
  with.effects.push_back(cause.effect());
  const double price = bench.price_of(with) - bench.price_of(set);
  std::optional<HiddenBursts> best;
  constexpr std::array block_s = {0.5, 1.0, 2.0, 4.0};
  constexpr std::size_t fewest_samples = 16, fewest_blocks = 50, apart = 3, furthest = 6,
                        lowest = 8;
  for (const double seconds : block_s) {
    const auto length = static_cast<std::size_t>(std::lround(seconds * conditions.rate_hz()));
    if (length < fewest_samples) continue;
    const double quarter_hz = 0.25 * conditions.rate_hz();
    const auto powers = block_powers(conditions, left_dps, noise, length, quarter_hz, quarter_hz);
    if (powers.told() < fewest_blocks || powers.bins() < lowest + 2 * furthest) continue;
    std::vector<Mixture> mixtures(powers.bins());
    tbb::parallel_for(std::size_t{0}, mixtures.size(), [&](std::size_t k) {
      std::vector<double> of_bin;
      for (const auto& span : powers.spans)
        for (const auto& block : span)
          if (!block.empty()) of_bin.push_back(block[k]);
      mixtures[k] = mixture_of(of_bin);
    });
    const double places = std::log(static_cast<double>(block_s.size() * mixtures.size()));
    for (std::size_t k = lowest; k + furthest < mixtures.size(); ++k) {
      const auto& m = mixtures[k];
      // What comes and goes in a wide band, as the flips of a grid, does so in others, too.
      double beside = 0.0;
      for (std::size_t by = apart; by <= furthest; ++by)
        beside = std::max({beside, mixtures[k - by].gain, mixtures[k + by].gain});
      const double log_odds = std::min(m.gain - price, m.gain - 2.0 * beside) - places;
      if (log_odds < clear || (best && log_odds <= best->log_odds)) continue;
      const auto course = course_of(powers, k, std::sqrt(m.on * m.off) * std::log(m.on / m.off));
      const effects::VibrationBursts bursts{
          .std_dps =
              std::sqrt(2.0 * powers.noise_dps2[k] * (m.on - m.off) / static_cast<double>(length)),
          .centre_hz = powers.resolution_hz * static_cast<double>(powers.first + k),
          .bandwidth_hz = powers.resolution_hz,
          .mean_duration_s = 1.01 * course.on_s,  // a block, at least
          .mean_interval_s = course.off_s};
      const Resonance band = band_of_line(Effect(bursts));
      const auto is_beside = [&](const Effect& effect) {
        return is_line(effect.id()) && are_neighbours(band_of_line(effect), band);
      };
      if (cause.is_what_it_is_called(bursts, conditions) &&
          std::none_of(set.effects.begin(), set.effects.end(), is_beside))
        best = {bursts, log_odds};
    }
  }
  return best;
}

}  // namespace gyrostat::gap
