#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <gyrostat/diagnosis/likelihood/nameless_colour.hpp>
#include <gyrostat/generators/effects/empirical_noise.hpp>

namespace gyrostat::gap {
namespace {

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

}  // namespace

std::optional<Nameless> colour_of_the_noise(const Conditions& conditions, const SetFitter& fitter,
                                            const Scenario& set) {
  const auto& reduced = fitter.reduced();
  const auto& seen = reduced.periodogram();
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
  const auto chosen = order_of(all, 2.0 * reduced.degrees() * static_cast<double>(last - first));
  if (chosen.gain < clear_gain) return std::nullopt;
  Effect effect =
      effects::EmpiricalNoise{.gain = std::sqrt(all.errors[chosen.order]), .reflection_1 = 0.0};
  for (std::size_t m = 0; m < chosen.order; ++m) effect.value(m + 1) = all.reflections[m];
  return Nameless{effect, change_in_words(ratio, plain, reduced.grid().resolution_hz())};
}

}  // namespace gyrostat::gap
