#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

namespace gyrostat::gap {
namespace {

std::vector<std::string> names_in(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& effect : scenario.effects) names.emplace_back(effect.id());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

void SetSearcher::draw_once(const Scenario& scenario) {
  constexpr int sweeps = 12;
  simulator_.interrupt().check();
  before_rounding_->draw(noise_about_level(law_of(scenario, conditions_.interval_s()),
                                           bench_.grid().angles(), conditions_.slow_interval_s()),
                         bench_.known_rate(scenario), sweeps);
  recording_.gyro_dps = before_rounding_->rate_dps();
}

Standing SetSearcher::drawn_before_rounding(Standing standing) {
  constexpr int turns = 12, iterations = 4;
  for (int turn = 0; turn < turns; ++turn) {
    draw_once(standing.scenario);
    standing = bench_.refitted(standing.scenario, iterations);
  }
  return bench_.refitted(standing.scenario);
}

double SetSearcher::gain_on_draws(const Scenario& whole, Standing rest) {
  constexpr int draws = 5;
  constexpr double by_chance = 1.0;  // of two parameters
  double sum = 0.0;
  for (int k = 0; k < draws; ++k) {
    draw_once(rest.scenario);
    rest = bench_.refitted(rest.scenario);
    sum += bench_.refitted(whole).fit.log_likelihood - rest.fit.log_likelihood;
  }
  return sum / draws - by_chance;
}

/// Of the log-likelihood that an effect gains on what was rounded, draws beside it show more, and
/// draws without it less, each by the share of what is known that rounding has left.
Standing SetSearcher::without_what_draws_show(Standing standing, FoundSet& found) {
  for (bool is_less = true; is_less;) {
    is_less = false;
    for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
      const std::string name(standing.scenario.effects[k].id());
      if (bench_.is_marked(name) || band_of(name) == EffectBand::motion) continue;
      tell(fmt::format("{} beside what rounding hides", name),
           standing.scenario.effects.size() - k);
      auto rest = bench_.without(standing, k);
      if (rest.score < -1e299) {
        auto others = standing.scenario;
        others.effects.erase(others.effects.begin() + static_cast<std::ptrdiff_t>(k));
        rest = bench_.refitted(others);
      }
      const double beside = standing.fit.log_likelihood - rest.fit.log_likelihood;
      const double price = beside - (standing.score - rest.score);
      const auto drawn = *before_rounding_;
      rest = drawn_before_rounding(std::move(rest));
      const double without = gain_on_draws(standing.scenario, rest);
      const double gain = std::sqrt(std::max(0.0, beside) * std::max(0.0, without)) - price;
      if (gain <= std::max(0.0, least_gain(rest, band_of(name)))) {
        std::erase_if(found.members, [&](const auto& m) { return m.effect == name; });
        std::erase_if(found.rivals, [&](const auto& r) { return r.instead_of == name; });
        standing = std::move(rest);
        is_less = true;
        break;
      }
      for (auto& m : found.members)
        if (m.effect == name) m.log_odds = std::min(m.log_odds, gain);
      for (auto& r : found.rivals)
        if (r.instead_of == name) r.log_odds *= std::sqrt(std::min(1.0, without / beside));
      before_rounding_ = drawn;
      recording_.gyro_dps = drawn.rate_dps();
    }
  }
  return standing;
}

Standing SetSearcher::drawn_anew(Standing standing, FoundSet& found) {
  constexpr int most_rounds = 4;
  const auto known = found.members;
  // Where there is nothing, what the law of the first draws has by chance must not be left.
  if (standing.scenario.effects.size() == begun_.scenario.effects.size())
    return drawn_before_rounding(std::move(standing));
  for (int round = 0; round < most_rounds; ++round) {
    const auto names = names_in(standing.scenario);
    standing = drawn_before_rounding(std::move(standing));
    found.members = known;
    found.rivals.clear();
    standing = concluded(searched_beside_tails(std::move(standing)), found);
    if (names_in(standing.scenario) == names) break;
  }
  return without_what_draws_show(std::move(standing), found);
}

}  // namespace gyrostat::gap
