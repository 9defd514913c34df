#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <gyrostat/diagnosis/likelihood/changed_band.hpp>
#include <gyrostat/diagnosis/likelihood/nameless_colour.hpp>
#include <gyrostat/generators/effects/empirical_noise.hpp>

namespace gyrostat::gap {
namespace {

std::string change_in_words(const std::vector<double>& ratio, const std::vector<double>& white,
                            double resolution_hz) {
  std::vector<double> change(ratio.size(), 0.0);
  for (std::size_t k = 1; k < ratio.size(); ++k) change[k] = (ratio[k] - 1.0) * white[k];
  const auto band = changed_band(change, resolution_hz);
  return fmt::format("{} of the noise without a name, mostly from {:.3g} to {:.3g} Hz",
                     band.adds ? "a surplus" : "a lack", band.from_hz, band.to_hz);
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
