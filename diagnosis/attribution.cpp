#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/diagnosing.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {

std::vector<Where> Diagnosing::departures_of(const Ensemble& ensemble) const {
  std::vector<Where> found;
  const auto& instrument = simulator_.instrument(Part::train);
  for (const auto& departure : ensemble.departures(observed_[0], thresholds::departure)) {
    const auto lens = std::find_if(
        instrument.lenses().begin(), instrument.lenses().end(), [&](const LensView& l) {
          return departure.reading >= l.first && departure.reading < l.first + l.count;
        });
    const auto& at = instrument.at()[static_cast<std::size_t>(departure.reading)];
    found.push_back({std::string(lens->id), std::string(lens->channel),
                     std::string(lens->coordinate), std::string(lens->unit), at.from, at.to,
                     observed_[0][departure.reading], ensemble.mean()[departure.reading],
                     departure.p_adjusted});
  }
  return found;
}

/// What closes most beside those before it comes next, and what may not be there after what is.
std::vector<std::size_t> Diagnosing::by_what_each_closes(const std::vector<std::string>& names) {
  std::vector<std::size_t> order, left(names.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto worth = [&](std::size_t k) {
    std::vector<std::string> some = {names[k]};
    for (const std::size_t before : order) some.push_back(names[before]);
    const bool is_clear = result_.effects[k].log_odds >= thresholds::clear_odds;
    const auto with = rung(names[k], with_effects(some), lacking_replicas);
    return std::pair(is_clear, scoring_->of(with.replicas[0]).value);
  };
  while (left.size() > 1) {
    std::vector<std::pair<bool, double>> worths;
    for (const std::size_t k : left) worths.push_back(worth(k));
    const auto most = std::max_element(worths.begin(), worths.end()) - worths.begin();
    order.push_back(left[static_cast<std::size_t>(most)]);
    left.erase(left.begin() + most);
  }
  order.push_back(left.front());
  return order;
}

/// One effect of the set after another.
void Diagnosing::climb(const std::vector<std::string>& order) {
  std::vector<std::string> names;
  for (const auto& name : order) {
    names.push_back(name);
    tell("adding one effect after another",
         0.75 + 0.08 * static_cast<double>(names.size() - 1) / static_cast<double>(order.size()),
         name);
    const bool is_whole = names.size() == order.size();
    rungs_.push_back(
        rung(name, is_whole ? result_.enriched : with_effects(names), options_.candidate_replicas));
  }
}

void Diagnosing::attribute() {
  const bool significant = result_.p_before <= options_.significance;
  for (const auto& [effect, gain] : found_.screening) result_.screening.emplace_back(effect, gain);
  if (found_.members.empty()) {
    if (!significant) return;
    result_.verdict = Verdict::unknown();
    result_.verdict_set = {Verdict::unknown()};
    return;
  }
  result_.enriched = with_drift(found_.scenario, recording_);
  auto names = weighed(found_.members, "weighing each effect");
  if (is_found_without_a_doubtful(names))
    names = weighed(found_.members, "weighing each effect again");
  const auto order = by_what_each_closes(names);
  std::vector<Included> effects;
  std::vector<LogScore> lacking;
  std::vector<std::string> ordered;
  for (const std::size_t k : order) {
    effects.push_back(result_.effects[k]);
    lacking.push_back(held_out_without_[k]);
    ordered.push_back(names[k]);
  }
  result_.effects = std::move(effects);
  held_out_without_ = std::move(lacking);
  climb(ordered);
  temper();

  const auto before = scoring_->of(
      baseline_replicas_[0].leftCols(static_cast<Eigen::Index>(options_.candidate_replicas)));
  const auto after = scoring_->of(rungs_.back().replicas[0]);
  result_.recovered = (after.value - before.value) / std::max(1e-9, after.expected - before.value);
  see_what_is_left();
  const bool misses =
      result_.p_after < thresholds::strictness_after * options_.significance ||
      (result_.p_after < thresholds::departure && after.deficit() > thresholds::deficit_of_a_miss);
  const bool open = result_.recovered < thresholds::recovery && misses;
  const double p_left = p_of_the_oddest(found_.unexplained);
  const bool is_no_form = p_left < thresholds::p_of_the_unknown &&
                          -std::log(p_left) > thresholds::share_of_form * found_.gain;
  // A doubtful name is no verdict before what the compass has and no name explains.
  const bool is_clear =
      std::any_of(result_.effects.begin(), result_.effects.end(),
                  [](const auto& e) { return e.log_odds >= thresholds::clear_odds; });
  const bool unexplained = (open && !(is_clear && only_the_compass_is_left())) || is_no_form ||
                           found_.nameless_log_odds > 0.0;
  result_.verdict =
      unexplained ? Verdict::unknown() : Verdict::cause(result_.effects.front().effect);
  if (unexplained) cannot_rule_out(Verdict::unknown());
  for (const auto& effect : result_.effects) cannot_rule_out(Verdict::cause(effect.effect));
  for (const auto& rival : found_.rivals)
    if (probability_of(rival.log_odds) >= thresholds::member_probability)
      cannot_rule_out(Verdict::cause(rival.effect));
  if (open || std::min(result_.p_after, p_left) < thresholds::p_of_the_unexplained)
    cannot_rule_out(Verdict::unknown());
  for (const auto& effect : result_.effects) {
    const auto scenario = with_effects({effect.effect});
    result_.causes.push_back(
        {.effect = effect.effect,
         .scenario = scenario,
         .log_score = effect.log_odds,
         .recovered = result_.recovered,
         .probability = unexplained ? effect.inclusion * std::clamp(result_.recovered, 0.0, 1.0)
                                    : effect.inclusion});
  }
  for (const auto& rival : found_.rivals) {
    Scenario scenario = result_.enriched;
    scenario.effects = {rival.found};
    result_.causes.push_back({.effect = rival.effect,
                              .scenario = scenario,
                              .log_score = rival.log_odds,
                              .recovered = result_.recovered,
                              .probability = probability_of(rival.log_odds)});
  }
}

void Diagnosing::cannot_rule_out(const Verdict& verdict) {
  auto& set = result_.verdict_set;
  if (std::find(set.begin(), set.end(), verdict) == set.end()) set.push_back(verdict);
}

/// The claimed effects, one after another, beside the claimed random error.
void Diagnosing::judge_claim() {
  Scenario scenario = result_.baseline;
  scenario.random_error = options_.claim->random_error;
  scenario.effects = options_.claim->effects;
  const auto& compass = options_.claim->compass;
  if (has(scenario, nameless_compass) ||
      compass.noise_std_deg > 0.0)  // else it says nothing of one
    scenario.compass.noise_std_deg = compass.noise_std_deg;
  result_.enriched = scenario;
  std::vector<std::string> names;
  for (const auto& effect : scenario.effects) {
    if (std::find(names.begin(), names.end(), effect.id()) != names.end()) continue;
    names.emplace_back(effect.id());
    cannot_rule_out(Verdict::cause(names.back()));
    const auto alone = with_effects({names.back()});
    result_.causes.push_back({.effect = names.back(), .scenario = alone});
    result_.causes.back().probability = no_value;  // it is claimed, whatever the odds
  }
  if (names.empty())
    rungs_.push_back(rung("the noise claimed", scenario, options_.candidate_replicas));
  else
    climb(names);
  result_.claimed = true;
  see_what_is_left();
  // What has no name closes a gap, and is no cause beside one.
  std::stable_partition(result_.verdict_set.begin(), result_.verdict_set.end(),
                        [](const auto& v) { return cause_types().find(v.text()) != nullptr; });
  if (!names.empty())
    result_.verdict = result_.verdict_set.front();
  else if (result_.p_after <= options_.significance)
    result_.verdict = Verdict::unknown();
  if (result_.p_after < thresholds::p_of_the_unexplained) cannot_rule_out(Verdict::unknown());
}

void Diagnosing::see_what_is_left() {
  const Ensemble enriched(simulator_.instrument(Part::train), rungs_.back().replicas[0], {});
  result_.p_after = enriched.p_value(observed_[0]);
  result_.where_after = departures_of(enriched);
  p_beside_compass_ = enriched.p_value_without("heading_deg", observed_[0]);
}

bool Diagnosing::is_left_in_the_compass_alone() const {
  const auto& where = result_.where_after;
  return result_.p_after < thresholds::departure && p_beside_compass_ >= thresholds::departure &&
         std::all_of(where.begin(), where.end(),
                     [](const auto& w) { return w.channel == "heading_deg"; });
}

bool Diagnosing::only_the_compass_is_left() const {
  const auto& effects = result_.enriched.effects;
  return is_left_in_the_compass_alone() &&
         std::none_of(effects.begin(), effects.end(),
                      [](const auto& effect) { return effect.stage() == Stage::compass; });
}

}  // namespace gyrostat::gap
