#include <gyrostat/diagnosis/likelihood/compass_search.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>

#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/likelihood/compass_errors.hpp>
#include <gyrostat/diagnosis/likelihood/compass_step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/heading_bursts.hpp>

namespace gyrostat::gap {
namespace {

constexpr double prior_odds = 3.0;
/// A further effect gains this share of what the clearest does.
constexpr double share_of_clearest = 0.003;

bool is_lag(const Effect& effect) { return effect.id() == "compass_lag"; }

class CompassSearch {
 public:
  CompassSearch(const Simulator& simulator, const Series& recording, FoundSet& found)
      : simulator_(simulator),
        conditions_(simulator.conditions()),
        recording_(recording),
        found_(found),
        errors_(conditions_, recording, found.baseline),
        hidden_(conditions_.slow_size(), 0),
        cost_of_a_value_(0.5 * std::log(static_cast<double>(recording.size()))) {}

  void run(const SetSearchOptions& options);

 private:
  CompassErrors::Law law_of(const std::vector<Effect>& effects) const {
    simulator_.interrupt().check();
    return errors_.law_of(effects, hidden_);
  }
  std::vector<Effect> polished(std::vector<Effect> set) const;
  std::vector<char> beside_turns(const std::vector<Effect>& effects) const;
  void find_bursts(const std::vector<Effect>& effects);
  double cost(const Effect& effect) const;
  /// Of an effect, from what others leave.
  std::vector<Effect> starts(const CauseType& cause, const std::vector<Effect>& beside) const;
  /// Whether clusters within bursts count.
  enum class Bursts { hidden, count };
  /// The set itself where that is no likelier.
  std::vector<Effect> in_other_form(std::vector<Effect> set, std::size_t at) const;
  /// Where iron and a lag are both there, what iron adds trails, too, or does not.
  std::vector<Effect> in_likelier_form(std::vector<Effect> set) const;
  /// One effect more. What iron does depends on the heading that it sees: that of the sensor, or
  /// one that trails; so it may stand at any place.
  struct Trial {
    const CauseType* cause;
    Effect start;
    std::size_t place;
  };
  std::vector<Trial> trials_beside(const std::vector<Effect>& set) const;
  /// With one effect after another, as long as each pays.
  std::vector<Effect> grown(std::vector<Effect> set, Bursts bursts);
  /// Log-likelihood of all means, bursts or not, less what the set costs.
  double robust_score(const std::vector<Effect>& set) const;
  std::vector<Effect> searched();

  const Simulator& simulator_;
  const Conditions& conditions_;
  const Series& recording_;
  FoundSet& found_;
  std::vector<const CauseType*> candidates_;
  CompassErrors errors_;
  std::vector<char> hidden_;  ///< a flag a cluster: within a burst
  double cost_of_a_value_;
  HeadingBursts bursts_;
};

/// Where a compass that trails does: while it turns, and until that has died out.
std::vector<char> CompassSearch::beside_turns(const std::vector<Effect>& effects) const {
  std::vector<char> flags(conditions_.slow_size(), 0);
  const auto lag = std::find_if(effects.begin(), effects.end(), is_lag);
  if (lag == effects.end()) return flags;
  constexpr double memories = 5.0, of_fastest = 0.05;
  const double trails_s = lag->value(field_of(*lag, "time_constant_s")) +
                          std::abs(lag->value(field_of(*lag, "delay_s")));
  const auto reach =
      static_cast<std::size_t>(std::ceil(memories * trails_s / conditions_.slow_interval_s()));
  const auto& rate = conditions_.series().rate_ref_dps;
  double fastest = 0.0;
  for (const double r : rate)
    if (!is_missing(r)) fastest = std::max(fastest, std::abs(r));
  for (std::size_t i = 0; i < rate.size(); ++i) {
    if (!(std::abs(rate[i]) > of_fastest * fastest)) continue;
    const std::size_t first = i / conditions_.cluster();
    for (std::size_t k = first; k < std::min(first + reach + 1, flags.size()); ++k) flags[k] = 1;
  }
  return flags;
}

void CompassSearch::find_bursts(const std::vector<Effect>& effects) {
  bursts_ = heading_bursts(conditions_, errors_.means_of(effects), beside_turns(effects));
  hidden_ = bursts_.hidden;
}

double CompassSearch::cost(const Effect& effect) const {
  return prior_odds +
         cost_of_a_value_ * static_cast<double>(
                                cause_types().named(effect.id(), "effects").free_parameters.size());
}

std::vector<Effect> CompassSearch::starts(const CauseType& cause,
                                          const std::vector<Effect>& beside) const {
  const auto error = errors_.of(beside), plain = errors_.of({});
  Series left = recording_;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::size_t k = std::min(i / conditions_.cluster(), hidden_.size() - 1);
    left.heading_deg[i] = hidden_[k] != 0 || is_missing(error[i])
                              ? no_value
                              : wrap_degrees(left.heading_deg[i] + error[i] - plain[i]);
  }
  left.gyro_dps.clear();
  Evidence evidence{simulator_, recording_, Scene(conditions_, left), found_.baseline};
  evidence.baseline.compass.initial_heading_deg = errors_.centre_deg();
  return cause.starts(evidence);
}

std::vector<Effect> CompassSearch::polished(std::vector<Effect> set) const {
  auto law = law_of(set);
  for (int pass = 0; pass < 4; ++pass) {
    auto better = compass_step(errors_, conditions_, hidden_, set);
    const auto its_law = law_of(better);
    if (its_law.gain_on(law) <= 0.0) break;
    set = std::move(better);
    law = its_law;
  }
  return set;
}

std::vector<Effect> CompassSearch::in_other_form(std::vector<Effect> set, std::size_t at) const {
  auto& effect = set[at];
  const std::size_t field = field_of(effect, is_lag(effect) ? "turns_alone" : "exact");
  auto other = set;
  other[at].value(field) = 1.0 - effect.value(field);
  other = polished(other);
  return law_of(other).gain_on(law_of(set)) > 0.0 ? other : set;
}

std::vector<Effect> CompassSearch::in_likelier_form(std::vector<Effect> set) const {
  const auto lag = std::find_if(set.begin(), set.end(), is_lag);
  if (set.size() < 2 || lag == set.end()) return set;
  return in_other_form(std::move(set), static_cast<std::size_t>(lag - set.begin()));
}

std::vector<CompassSearch::Trial> CompassSearch::trials_beside(
    const std::vector<Effect>& set) const {
  std::vector<std::vector<Effect>> each(candidates_.size());
  tbb::parallel_for(std::size_t{0}, candidates_.size(), [&](std::size_t k) {
    const auto* cause = candidates_[k];
    if (std::none_of(set.begin(), set.end(), [&](const auto& e) { return e.id() == cause->id; }))
      each[k] = starts(*cause, set);
  });
  std::vector<Trial> trials;
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    for (const auto& start : each[k])
      for (std::size_t place = 0; place <= set.size(); ++place)
        trials.push_back({candidates_[k], start, place});
  return trials;
}

std::vector<Effect> CompassSearch::grown(std::vector<Effect> set, Bursts bursts) {
  double clearest = set.empty() ? 0.0 : law_of(set).gain_on(law_of({}));
  for (std::size_t step = set.size(); step <= candidates_.size(); ++step) {
    if (bursts == Bursts::hidden) find_bursts(set);
    const CompassErrors::Law before = law_of(set);
    const auto trials = trials_beside(set);
    std::vector<double> gains(trials.size(), -1e300);
    std::vector<std::vector<Effect>> fitted(trials.size());
    tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t k) {
      const auto& [cause, start, place] = trials[k];
      auto trial = set;
      trial.insert(trial.begin() + static_cast<std::ptrdiff_t>(place), start);
      trial = in_likelier_form(polished(trial));
      if (!cause->is_what_it_is_called(trial[place], conditions_)) return;
      gains[k] = law_of(trial).gain_on(before) - cost(start);
      fitted[k] = std::move(trial);
    });
    std::vector<Effect> best;
    // Nature's form of what is there differs from ours by as much.
    double most = share_of_clearest * clearest;
    for (std::size_t k = 0; k < trials.size(); ++k)
      if (gains[k] > most) {
        most = gains[k];
        best = fitted[k];
      }
    if (best.empty()) break;
    clearest = std::max(clearest, most);
    set = best;
  }
  return set;
}

double CompassSearch::robust_score(const std::vector<Effect>& set) const {
  const auto slow = errors_.means_of(set);
  std::vector<double> squares;
  for (const auto& span : conditions_.slow_spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(slow[i])) squares.push_back(slow[i] * slow[i]);
  if (squares.empty()) return 0.0;
  // Student's law of three degrees of freedom, its scale by expectation-maximisation.
  constexpr double freedom = 3.0;
  const auto n = static_cast<double>(squares.size());
  double scale = std::accumulate(squares.begin(), squares.end(), 1e-18) / n;
  for (int pass = 0; pass < 50; ++pass) {
    double sum = 1e-18;
    for (const double s : squares) sum += (freedom + 1.0) * s / (freedom + s / scale);
    scale = sum / n;
  }
  double score = -0.5 * n * std::log(scale);
  for (const double s : squares) score -= 0.5 * (freedom + 1.0) * std::log1p(s / (freedom * scale));
  for (const auto& effect : set) score -= cost(effect);
  return score;
}

/// At rest a compass repeats itself, and iron that shows while it turns looks like bursts; and
/// bursts that are fitted look like iron. So it is begun from either.
std::vector<Effect> CompassSearch::searched() {
  const auto first_bursts = grown({}, Bursts::hidden);
  std::fill(hidden_.begin(), hidden_.end(), char{0});
  auto first_iron = grown({}, Bursts::count);
  find_bursts(first_iron);
  first_iron = grown(polished(first_iron), Bursts::hidden);
  auto set = robust_score(first_iron) > robust_score(first_bursts) ? first_iron : first_bursts;
  find_bursts(set);
  return polished(set);
}

void CompassSearch::run(const SetSearchOptions& options) {
  const auto is_left_out = [&](std::string_view id) {
    return std::find(options.without.begin(), options.without.end(), id) != options.without.end();
  };
  for (const auto& cause : cause_types())
    if (cause.effect().stage() == Stage::compass && cause.id != "magnetic_bursts" &&
        !is_left_out(cause.id) && cause.why_not_assessable(conditions_).empty())
      candidates_.push_back(&cause);
  auto set = searched();
  const bool lags = std::any_of(set.begin(), set.end(), is_lag);
  if (lags)
    errors_.unshift();
  else
    errors_.shift_beside(set, hidden_);
  if (!set.empty()) {
    set = polished(set);
    for (std::size_t k = 0; k < set.size(); ++k)
      if (!is_lag(set[k])) set = in_other_form(std::move(set), k);
    find_bursts(set);
    set = polished(set);
    if (!lags) errors_.shift_beside(set, hidden_);
  }
  std::vector<Member> members;
  for (std::size_t k = 0; k < set.size();) {
    auto rest = set;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    // A shift of time may stand for the lag.
    const bool without_lag = is_lag(set[k]);
    const auto with = law_of(set);
    if (without_lag) errors_.shift_beside(rest, hidden_);
    rest = polished(rest);
    if (without_lag) errors_.shift_beside(rest, hidden_);
    const double odds = with.gain_on(law_of(rest)) - cost(set[k]);
    if (without_lag && odds > 0.0) errors_.unshift();
    if (odds <= 0.0) {
      set = rest;
      members.clear();
      k = 0;
      continue;
    }
    members.push_back({std::string(set[k].id()), odds});
    ++k;
  }
  const auto law = law_of(set);
  found_.scenario.compass.noise_std_deg = law.std_deg();
  found_.scenario.compass.initial_heading_deg = errors_.centre_deg();
  found_.baseline.compass.noise_std_deg = law_of({}).std_deg();
  found_.baseline.compass.initial_heading_deg = errors_.centre_deg();
  if (found_.log_score_gained) {
    *found_.log_score_gained += law.gain_on(law_of({}));
    for (const auto& effect : set) *found_.log_score_gained -= cost(effect);
    if (std::any_of(hidden_.begin(), hidden_.end(), [](char hidden) { return hidden != 0; }))
      found_.log_score_gained.reset();
  }
  const double odds_of_bursts = bursts_.gain - 3.0 * cost_of_a_value_ - prior_odds;
  if (!is_left_out("magnetic_bursts") && odds_of_bursts > 0.0) {
    set.push_back(with_values("magnetic_bursts", {{"bursts_per_hour", bursts_.per_hour},
                                                  {"mean_duration_s", bursts_.duration_s},
                                                  {"std_deg", bursts_.size_deg}}));
    members.push_back({"magnetic_bursts", odds_of_bursts});
  }
  found_.scenario.effects.insert(found_.scenario.effects.end(), set.begin(), set.end());
  found_.members.insert(found_.members.end(), members.begin(), members.end());
}

}  // namespace

void search_compass(const Simulator& simulator, const Series& recording,
                    const SetSearchOptions& options, FoundSet& found) {
  CompassSearch(simulator, recording, found).run(options);
}

}  // namespace gyrostat::gap
