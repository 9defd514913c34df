#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>

#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>
#include <gyrostat/generators/effects/gauss_markov.hpp>

namespace gyrostat::gap {
namespace {

/// Too narrow to stand in for a filter.
bool is_a_line(const Effect& effect) {
  constexpr double narrow = 0.25;
  if (!is_line(effect.id())) return effect.id() == "sinusoidal";
  const auto band = band_of_line(effect);
  return band.bandwidth_hz < narrow * band.centre_hz;
}

}  // namespace

Standing SetSearcher::coloured_anew(const Standing& standing) {
  const auto colours = [&](std::string_view effect) {
    return !bench_.is_marked(effect) && band_of(effect) == EffectBand::fast;
  };
  const auto& effects = standing.scenario.effects;
  if (std::count_if(effects.begin(), effects.end(),
                    [&](const auto& effect) { return colours(effect.id()); }) < 2)
    return standing;
  Scenario plain = standing.scenario;
  std::erase_if(plain.effects,
                [&](const auto& effect) { return colours(effect.id()) && !is_a_line(effect); });
  // Not fitted: what is slow would take up what filters explain.
  const auto rest =
      bench_.fitted(standing.fitter->with_white_noise_scaled(std::move(plain)), standing.fitter, 0);
  const auto& angle = cause_types().named("angle_quantization", "effects");
  Scenario with_angle = rest.scenario;
  with_angle.effects.push_back(angle.guesses(Beside{conditions_, *rest.fitter, rest.fit}).front());
  const auto beside_angle = bench_.fitted(with_angle, rest.fitter, 0);
  std::vector<Standing> firsts;
  for (const auto* id : {"noise_averaging", "noise_bandwidth"}) {
    if (!bench_.is_allowed(id) || bench_.is_marked(id)) continue;
    const auto& filter = cause_types().named(id, "effects");
    firsts.push_back(bench_.with(rest, filter, nullptr));
    if (!bench_.is_allowed(angle.id) || bench_.is_marked(angle.id)) continue;
    // Beside a filter that stands in for both an angle's errors gain nothing.
    if (auto both = bench_.with(beside_angle, filter, nullptr); both.score > firsts.back().score)
      firsts.push_back(std::move(both));
  }
  return best_from(standing, std::move(firsts), EffectBand::fast);
}

Standing SetSearcher::without_wide_lines(const Standing& standing) {
  const auto& angle = cause_types().named("angle_quantization", "effects");
  if (!bench_.is_allowed(angle.id) || bench_.is_marked(angle.id) ||
      has(standing.scenario, angle.id))
    return standing;
  Scenario plain = standing.scenario;
  if (std::erase_if(plain.effects, [](const auto& effect) {
        return is_line(effect.id()) && !is_a_line(effect);
      }) == 0)
    return standing;
  Scenario still = plain;
  std::erase_if(still.effects, [](const auto& effect) { return is_slow(effect.id()); });
  std::vector<Standing> firsts;
  for (const auto& beginning : {plain, still}) {
    const auto rest =
        bench_.fitted(standing.fitter->with_white_noise_scaled(beginning), standing.fitter, 0);
    firsts.push_back(bench_.with(rest, angle, nullptr));
  }
  // Three effects in the place of one are no surer for a few nats.
  constexpr double clear = 10.0;
  auto best = best_from(standing, std::move(firsts), std::nullopt);
  return best.score > standing.score + clear ? best : standing;
}

Standing SetSearcher::best_from(const Standing& standing, std::vector<Standing> beginnings,
                                std::optional<EffectBand> band) {
  const auto all = candidates_;
  std::erase_if(candidates_, [&](const auto* cause) {
    return bench_.is_marked(cause->id) || (band && band_of(cause->id) != *band);
  });
  const auto gains = gains_;
  auto gains_of_best = gains_;
  const double least = least_gain(standing, band.value_or(EffectBand::fast));
  Standing best = standing;
  double most = standing.score;
  for (const auto& beginning : beginnings) {
    if (beginning.score < -1e299) continue;
    gains_ = gains;
    auto other = searched(beginning);
    // What stands in the place of another is no further effect.
    const auto further = static_cast<double>(other.scenario.effects.size()) -
                         static_cast<double>(standing.scenario.effects.size());
    const double worth = other.score - least * std::max(0.0, further);
    if (worth <= most) continue;
    most = worth;
    best = std::move(other);
    gains_of_best = gains_;
  }
  gains_ = std::move(gains_of_best);
  candidates_ = all;
  return best;
}

Standing SetSearcher::beside_memory(const Standing& standing) const {
  if (standing.scenario.random_error.phi != 0.0) return {};
  Standing best = bench_.beside_memory(standing);
  const auto try_without = [&](const auto& is_in_its_place) {
    Scenario plain = standing.scenario;
    std::erase_if(plain.effects, [&](const auto& effect) {
      return !bench_.is_marked(effect.id()) && is_in_its_place(effect);
    });
    if (plain.effects.size() == standing.scenario.effects.size()) return;
    if (auto other = bench_.beside_memory(bench_.refitted(plain)); other.score > best.score)
      best = std::move(other);
  };
  try_without([](const Effect& effect) { return band_of(effect.id()) == EffectBand::fast; });
  // A walk whose steps remember one another is smooth, too.
  try_without([](const Effect& effect) {
    const auto* process = effect.as<effects::GaussMarkov>();
    return process != nullptr && process->is_of_second_order();
  });
  return best;
}

}  // namespace gyrostat::gap
