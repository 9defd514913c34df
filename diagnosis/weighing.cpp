#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/diagnosing.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

std::vector<std::string> names_of(const std::vector<Member>& members) {
  std::vector<std::string> names;
  for (const auto& m : members) names.push_back(m.effect);
  return names;
}

}  // namespace

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

bool Diagnosing::is_missed_by(const Rung& rung) const {
  const Ensemble enriched(simulator_.instrument(Part::train), rung.replicas[0], {});
  return enriched.p_value(observed_[0]) < thresholds::strictness_after * options_.significance;
}

/// An effect that the readings of its own channel bear out stays, whatever the others miss, and so
/// does one that no misfit would feign. Of two wrong ones either may be needed beside the other, as
/// a filter and what makes up for it: then both go, where a third is left.
std::vector<std::size_t> Diagnosing::needless_among(const std::vector<Member>& members,
                                                    std::vector<Rung> without, Rung& whole) {
  std::vector<std::size_t> doubtful;
  for (std::size_t k = members.size(); k-- > 0;)
    if (members[k].log_odds < thresholds::odds_beyond_misfits &&
        tempered(members[k], whole) < thresholds::clear_odds)
      doubtful.push_back(k);
  std::vector<std::size_t> needless;
  double most = scoring_->of(whole.replicas[0]).value;
  const auto may_go = [&](Rung& rest, const std::vector<std::size_t>& which) {
    const double value = scoring_->of(rest.replicas[0]).value;
    if (value < most) return;
    most = value;
    needless = which;
    whole = std::move(rest);
  };
  for (const std::size_t k : doubtful) may_go(without[k], {k});
  if (!needless.empty() || members.size() == 2) return needless;
  for (auto k = doubtful.begin(); k != doubtful.end(); ++k)
    for (auto l = std::next(k); l != doubtful.end(); ++l) {
      auto others = names_of(members);
      std::erase(others, members[*k].effect);
      std::erase(others, members[*l].effect);
      auto rest = rung({}, with_effects(others), lacking_replicas);
      may_go(rest, {*k, *l});
    }
  return needless;
}

std::vector<std::string> Diagnosing::weighed(std::vector<Member> members,
                                             const std::string& phase) {
  auto whole = rung({}, result_.enriched, lacking_replicas);
  for (;;) {
    const auto names = names_of(members);
    const auto truth = scoring_->of(whole.replicas[0]);
    std::vector<Rung> without;
    result_.effects.clear();
    held_out_without_.clear();
    for (const auto& m : members) {
      tell(phase,
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
           .given = m.given,
           .p_equal = m.p_equal,
           .parameters = {},
           .intervals = {}});
      held_out_without_.push_back(held_out_scoring_->of(without.back().replicas[1]));
      for (const auto& effect : result_.enriched.effects)
        if (effect.id() == m.effect) result_.effects.back().parameters.push_back(effect);
      add_intervals(result_.effects.back());
    }
    if (members.size() < 2 || !is_missed_by(whole)) return names;
    const auto needless = needless_among(members, std::move(without), whole);
    if (needless.empty()) return names;
    result_.enriched = whole.scenario;
    for (const std::size_t k : needless)
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

bool Diagnosing::is_found_without_a_doubtful(const std::vector<std::string>& names) {
  const Member* doubtful = nullptr;
  for (const auto& m : found_.members)
    if (!m.read_off && !m.given && m.log_odds < thresholds::clear_odds &&
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
  tell("looking again", search_share, "without " + doubtful->effect);
  auto with = std::exchange(found_, find_set(simulator_, recording_, {.without = without}));
  if (!given_.empty() && found_.beside) found_ = found_.beside(given_);
  const auto other = rung({}, with_drift(found_.scenario, recording_), lacking_replicas);
  // Nor are names given up for none.
  if (found_.members.empty() || is_missed_by(other)) {
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

}  // namespace gyrostat::gap
