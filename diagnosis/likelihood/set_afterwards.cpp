#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

namespace gyrostat::gap {

Scenario SetSearcher::subset_of(const Scenario& whole, const std::vector<std::string>& names,
                                Anew what) {
  const auto is_in = [&](std::string_view id) {
    return std::find(names.begin(), names.end(), id) != names.end();
  };
  const bool repeats =
      is_in("stale_samples") || is_in("saturation") || bench_.is_marked("dead_zone");
  bench_.mask_only(repeats ? repeats_ : std::vector<char>(recording_.size(), 0));
  bench_.take_out_response(std::nullopt);
  if (is_in("outliers") && !tails_.innovational) bench_.mask_too(tails_.outliers);
  Scenario some = whole;
  some.effects.clear();
  for (const auto& effect : whole.effects)
    if (is_in(effect.id()) && !(coarse_grid_ && effect.id() == coarse_grid_->id()))
      some.effects.push_back(effect);
  bench_.mask_too(edges_of_the_dead_zone(some));
  Scenario rate = some;
  std::erase_if(rate.effects, [](const auto& e) { return e.stage() == Stage::compass; });
  rate = with_walk_of_at_least(std::move(rate),
                               0.03 * rate.random_error.measurement_noise_std_dps /
                                   std::sqrt(static_cast<double>(conditions_.cluster())));
  auto fit = bench_.refitted(rate, 8);
  if (auto other = bench_.beside_noise(rate.effects); other.score > fit.score)
    fit = std::move(other);
  if (what == Anew::all) {
    auto fitted = fit.scenario.effects.begin();
    for (auto& effect : some.effects)
      if (effect.stage() != Stage::compass) effect = *fitted++;
  }
  some.random_error = fit.scenario.random_error;
  leave_to_tails(some, some.random_error);
  if (coarse_grid_ && is_in(coarse_grid_->id())) put_grid_back(some);
  if (white_at_rest_dps_ && is_in("quantization"))
    some.random_error.measurement_noise_std_dps = *white_at_rest_dps_;
  return some;
}

std::vector<Nameless> SetSearcher::nameless_beside(const Scenario& set) const {
  if (!end_) return {};
  auto parts = nameless_parts(simulator_, recording_, *end_->fitter, end_->scenario, set);
  // First: the others are found beside it, with the noise that they leave.
  if (response_)
    parts.insert(parts.begin(),
                 {*response_, "a response to the motion without a name, within four samples",
                  end_->scenario.random_error});
  for (auto& part : parts)
    if (part.beside) leave_to_tails(set, *part.beside);
  return parts;
}

std::vector<Detectable> SetSearcher::detectable() {
  if (!end_) return {};
  // As at the end: a subset has other samples and no response taken out.
  bench_.mask_only(masked_);
  bench_.take_out_response(response_);
  return detectable_beside(
      bench_, *end_, [&](std::string_view effect) { return least_gain(*end_, band_of(effect)); });
}

}  // namespace gyrostat::gap
