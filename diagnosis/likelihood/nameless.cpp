#include <gyrostat/diagnosis/likelihood/nameless.hpp>

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/diagnosis/gap/scene.hpp>
#include <gyrostat/diagnosis/likelihood/autoregression.hpp>
#include <gyrostat/generators/effects/empirical_compass_noise.hpp>
#include <gyrostat/generators/effects/empirical_noise.hpp>

namespace gyrostat::gap {
namespace {

constexpr double clear_gain = 10.0;  ///< nats beyond what its parameters win by chance

struct Chosen {
  std::size_t order;
  double gain;  ///< nats against white noise of variance 1, less one a parameter
};
/// From so many independent values.
Chosen order_of(const Autoregression& all, double values) {
  Chosen best{0, -1e300};
  for (std::size_t p = 0; p < all.errors.size(); ++p) {
    const double gain =
        0.5 * values * (all.errors[0] - 1.0 - std::log(all.errors[p])) - static_cast<double>(p + 1);
    if (gain > best.gain) best = {p, gain};
  }
  return best;
}

/// Where most of a change of the spectrum lies: the middle two thirds of what was added, or of what
/// was taken away.
std::string change_in_words(const std::vector<double>& ratio, const std::vector<double>& white,
                            double resolution_hz) {
  double added = 0.0, taken = 0.0;
  for (std::size_t k = 1; k < ratio.size(); ++k)
    (ratio[k] > 1.0 ? added : taken) += std::abs(ratio[k] - 1.0) * white[k];
  const bool adds = added >= taken;
  const double all = adds ? added : taken;
  double sum = 0.0, from_hz = 0.0, to_hz = 0.0;
  for (std::size_t k = 1; k < ratio.size(); ++k) {
    if ((ratio[k] > 1.0) != adds) continue;
    const double before = sum;
    sum += std::abs(ratio[k] - 1.0) * white[k];
    const double at = resolution_hz * static_cast<double>(k);
    if (before < all / 6.0 && sum >= all / 6.0) from_hz = at;
    if (before < all * 5.0 / 6.0 && sum >= all * 5.0 / 6.0) to_hz = at;
  }
  return fmt::format("{} of the noise without a name, mostly from {:.3g} to {:.3g} Hz",
                     adds ? "a surplus" : "a lack", from_hz, to_hz);
}

std::optional<Nameless> colour_of_the_noise(const Conditions& conditions, const SetFitter& fitter,
                                            const Scenario& set) {
  const auto& reduced = fitter.reduced();
  const auto& seen = reduced.periodogram(Part::train);
  if (seen.size() < 16) return std::nullopt;
  const auto law = law_of(set, conditions.interval_s());
  NoiseLaw white{.interval_s = law.interval_s, .white = law.white};
  white.filter = law.filter;
  white.averaging = law.averaging;
  const auto density_of_law = [&](const NoiseLaw& of) {
    return reduced.grid().shown(density_of(of, reduced.grid().angles()));
  };
  const auto whole = density_of_law(law), plain = density_of_law(white);
  constexpr double least = 0.02;  // what is taken away leaves something
  const std::size_t first = reduced.grid().first_fast_bin();
  std::vector<double> ratio(seen.size());
  for (std::size_t k = first; k < seen.size(); ++k)
    ratio[k] = std::max(least, 1.0 + (seen[k] - whole[k]) / plain[k]);
  // Below, the noise is not seen: slow errors are.
  constexpr std::size_t width = 4;
  const auto lowest = ratio.begin() + static_cast<std::ptrdiff_t>(first);
  std::fill(ratio.begin(), lowest, std::accumulate(lowest, lowest + width, 0.0) / width);
  // Half a spectrum has its ends once.
  std::vector<double> covariance(effects::EmpiricalNoise::order + 1, 0.0);
  const auto last = ratio.size() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    for (std::size_t lag = 0; lag < covariance.size(); ++lag)
      covariance[lag] += (k == 0 || k == last ? 0.5 : 1.0) * ratio[k] *
                         std::cos(static_cast<double>(lag) * reduced.grid().angles().values[k]) /
                         static_cast<double>(last);
  const auto all = autoregression(covariance);
  const auto chosen =
      order_of(all, 2.0 * reduced.degrees(Part::train) * static_cast<double>(last - first));
  if (chosen.gain < clear_gain) return std::nullopt;
  Effect effect =
      effects::EmpiricalNoise{.gain = std::sqrt(all.errors[chosen.order]), .reflection_1 = 0.0};
  for (std::size_t m = 0; m < chosen.order; ++m) effect.value(m + 1) = all.reflections[m];
  return Nameless{effect, change_in_words(ratio, plain, reduced.grid().resolution_hz())};
}

std::optional<Nameless> colour_of_the_compass(const Simulator& simulator, const Series& recording,
                                              const Scenario& set) {
  const auto& conditions = simulator.conditions();
  const double white = set.compass.noise_std_deg;
  if (!conditions.has_heading() || !(white > 0.0)) return std::nullopt;
  for (const auto& effect : set.effects)
    if (effect.id() == "magnetic_bursts") return std::nullopt;
  Scenario quiet = set;
  quiet.compass.noise_std_deg = 0.0;
  const auto left = Scene(conditions, recording, train_alone).heading_error_deg;
  const Series replica = simulator.replica(quiet, 0);
  const auto repeated = Scene(conditions, replica, train_alone).heading_error_deg;
  std::vector<double> sums(effects::EmpiricalCompassNoise::order + 1, 0.0),
      counts(sums.size(), 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      for (std::size_t lag = 0; lag < sums.size() && i >= span.first + lag; ++lag) {
        const double product = (left[i] - repeated[i]) * (left[i - lag] - repeated[i - lag]);
        if (is_missing(product)) continue;
        sums[lag] += product;
        counts[lag] += 1.0;
      }
  if (counts.back() < 100.0) return std::nullopt;
  for (std::size_t lag = 0; lag < sums.size(); ++lag) sums[lag] /= counts[lag] * white * white;
  const auto all = autoregression(sums);
  const auto chosen = order_of(all, counts[0]);
  if (chosen.gain < clear_gain) return std::nullopt;
  Effect effect = effects::EmpiricalCompassNoise{
      .innovation_std_deg = white * std::sqrt(all.errors[chosen.order]), .reflection_1 = 0.0};
  for (std::size_t m = 0; m < chosen.order; ++m) effect.value(m + 1) = all.reflections[m];
  return Nameless{effect, fmt::format("a compass noise that is not white (correlation {:.2f} from "
                                      "sample to sample)",
                                      sums[1] / sums[0])};
}

}  // namespace

std::vector<Nameless> nameless_parts(const Simulator& simulator, const Series& recording,
                                     const SetFitter& fitter, const Scenario& fitted,
                                     const Scenario& set) {
  std::vector<Nameless> parts;
  if (auto noise = colour_of_the_noise(simulator.conditions(), fitter, fitted))
    parts.push_back(*noise);
  if (auto compass = colour_of_the_compass(simulator, recording, set)) parts.push_back(*compass);
  return parts;
}

Scenario with_nameless(Scenario set, const std::vector<Nameless>& parts) {
  for (const auto& part : parts) {
    // The colour is that of all the noise there is.
    if (part.effect.stage() == Stage::compass) set.compass.noise_std_deg = 0.0;
    set.effects.push_back(part.effect);
  }
  return set;
}

}  // namespace gyrostat::gap
