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

/// Those of the search are of the effects under the names that it fitted them by.
void Diagnosing::add_intervals(Included& included) const {
  if (included.parameters.empty()) return;
  const auto& effects = found_.scenario.effects;
  const auto first = std::find_if(effects.begin(), effects.end(), [&](const auto& effect) {
    return effect.id() == included.effect;
  });
  included.intervals.assign(included.parameters.front().fields().size(), {no_value, no_value});
  for (const auto& interval : found_.intervals)
    if (first == effects.begin() + static_cast<std::ptrdiff_t>(interval.effect))
      included.intervals[interval.field] = {interval.low, interval.high};
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

bool Diagnosing::is_missed_by(const Rung& rung) const {
  const Ensemble enriched(simulator_.instrument(Part::train), rung.replicas[0], {});
  return enriched.p_value(observed_[0]) < thresholds::strictness_after * options_.significance;
}

std::vector<std::string> Diagnosing::weighed(std::vector<Member> members) {
  auto whole = rung({}, result_.enriched, lacking_replicas);
  for (;;) {
    std::vector<std::string> names;
    for (const auto& m : members) names.push_back(m.effect);
    const auto truth = scoring_->of(whole.replicas[0]);
    std::vector<Rung> without;
    result_.effects.clear();
    held_out_without_.clear();
    for (const auto& m : members) {
      tell("weighing each effect",
           0.65 + 0.1 * static_cast<double>(result_.effects.size()) /
                      static_cast<double>(members.size()),
           m.effect);
      auto others = names;
      std::erase(others, m.effect);
      without.push_back(rung(m.effect, with_effects(others), lacking_replicas));
      result_.effects.push_back(
          {.effect = m.effect,
           .inclusion = probability_of(m.log_odds),
           .log_odds = m.log_odds,
           .lack = truth.value - scoring_->of(without.back().replicas[0]).value,
           .gap_without = 0.0,
           .parameters = {},
           .intervals = {}});
      held_out_without_.push_back(held_out_scoring_->of(without.back().replicas[1]));
      for (const auto& effect : result_.enriched.effects)
        if (effect.id() == m.effect) result_.effects.back().parameters.push_back(effect);
      add_intervals(result_.effects.back());
    }
    if (members.size() < 2 || !is_missed_by(whole)) return names;
    // An effect that the readings of its own channel bear out stays, whatever the others miss.
    std::ptrdiff_t at = -1;
    for (std::size_t k = 0; k < members.size(); ++k)
      if (const double lack = result_.effects[k].lack;
          lack <= 0.0 && tempered(members[k], whole) < thresholds::clear_odds &&
          (at < 0 || lack < result_.effects[static_cast<std::size_t>(at)].lack))
        at = static_cast<std::ptrdiff_t>(k);
    if (at < 0) return names;
    result_.enriched = without[static_cast<std::size_t>(at)].scenario;
    whole = std::move(without[static_cast<std::size_t>(at)]);
    members.erase(members.begin() + at);
  }
}

bool Diagnosing::is_found_without_a_doubtful(const std::vector<std::string>& names) {
  const Member* doubtful = nullptr;
  for (const auto& m : found_.members)
    if (!m.read_off && m.log_odds < thresholds::clear_odds &&
        std::find(names.begin(), names.end(), m.effect) != names.end() &&
        (doubtful == nullptr || m.log_odds < doubtful->log_odds))
      doubtful = &m;
  if (names.size() < 2 || doubtful == nullptr ||
      !is_missed_by(rung({}, result_.enriched, lacking_replicas)))
    return false;
  // A search takes long: only where the others would do.
  auto others = names;
  std::erase(others, doubtful->effect);
  if (is_missed_by(rung({}, with_drift(found_.anew(others), recording_), lacking_replicas)))
    return false;
  auto without = options_.without;
  without.push_back(doubtful->effect);
  for (const auto& rival : found_.rivals)
    if (rival.instead_of == doubtful->effect) without.push_back(rival.effect);
  tell("looking for effects", search_share, "without " + doubtful->effect);
  auto with = std::exchange(found_, find_set(simulator_, recording_, {.without = without}));
  const auto other = rung({}, with_drift(found_.scenario, recording_), lacking_replicas);
  if (is_missed_by(other)) {
    found_ = std::move(with);
    return false;
  }
  result_.enriched = other.scenario;
  result_.unexplained = found_.unexplained;
  result_.log_score_gained = found_.log_score_gained;
  subsets_.clear();
  return true;
}

double Diagnosing::tempered(const Member& member, const Rung& set) const {
  if (member.read_off) return member.log_odds;
  const bool of_compass =
      cause_types().named(member.effect, "effects").effect().stage() == Stage::compass;
  const Ensemble enriched(simulator_.instrument(Part::train), set.replicas[0], {});
  const auto z = enriched.deviations(observed_[0]);
  double squares = 0.0, count = 0.0;
  for (const auto& lens : enriched.lenses()) {
    if ((lens.channel == "heading_deg") != of_compass) continue;
    squares += z.segment(lens.first, lens.count).squaredNorm();
    count += static_cast<double>(lens.count);
  }
  return member.log_odds / std::max(1.0, squares / std::max(1.0, count));
}

void Diagnosing::temper() {
  for (auto& effect : result_.effects) {
    const auto member = std::find_if(found_.members.begin(), found_.members.end(),
                                     [&](const auto& m) { return m.effect == effect.effect; });
    effect.log_odds = tempered(*member, rungs_.back());
    effect.inclusion = probability_of(effect.log_odds);
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
  // What lacks most without it comes first.
  auto names = weighed(found_.members);
  if (is_found_without_a_doubtful(names)) names = weighed(found_.members);
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result_.effects[a].lack > result_.effects[b].lack;
  });
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
  const bool misses = after.deficit() > thresholds::deficit_of_a_miss ||
                      result_.p_after < thresholds::strictness_after * options_.significance;
  const bool open = result_.recovered < thresholds::recovery && misses;
  const double p_left = p_of_the_oddest(found_.unexplained);
  const bool is_no_form = p_left < thresholds::p_of_the_unknown &&
                          -std::log(p_left) > thresholds::share_of_form * found_.gain;
  const bool unexplained =
      (open && !only_the_compass_is_left()) || is_no_form || found_.nameless_log_odds > 0.0;
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
    names.emplace_back(effect.id());
    result_.verdict_set.push_back(Verdict::cause(names.back()));
    const auto alone = with_effects({names.back()});
    result_.causes.push_back({.effect = names.back(), .scenario = alone});
    result_.causes.back().probability = 1.0;
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
}

void Diagnosing::see_what_is_left() {
  const Ensemble enriched(simulator_.instrument(Part::train), rungs_.back().replicas[0], {});
  result_.p_after = enriched.p_value(observed_[0]);
  result_.where_after = departures_of(enriched);
}

bool Diagnosing::only_the_compass_is_left() const {
  const auto& effects = result_.enriched.effects;
  const auto& where = result_.where_after;
  return !where.empty() && std::all_of(where.begin(), where.end(), [](const auto& w) {
    return w.channel == "heading_deg";
  }) && std::none_of(effects.begin(), effects.end(), [](const auto& effect) {
    return effect.stage() == Stage::compass;
  });
}

}  // namespace gyrostat::gap
