#include <gyrostat/diagnosis/likelihood/compass_search.hpp>

#include <algorithm>
#include <optional>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/likelihood/compass_bench.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

/// A further effect gains this share of what the clearest does.
constexpr double share_of_clearest = 0.003;
/// Or this, in nats, where nothing of the turning is left.
constexpr double clear = 10.0;

class CompassSearch {
 public:
  CompassSearch(const Simulator& simulator, const Series& recording, FoundSet& found)
      : bench_(simulator, recording, found.baseline), found_(found) {}

  void run(const SetSearchOptions& options);

 private:
  /// Whether clusters within bursts count.
  enum class Bursts { hidden, count };
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
  std::vector<Effect> searched();
  /// The shift of time, the forms and the bursts beside the set that was found.
  std::vector<Effect> settled(std::vector<Effect> set);
  /// Each against the set without it; those that do not pay are taken out of it.
  std::vector<Member> members_of(std::vector<Effect>& set);

  CompassBench bench_;
  FoundSet& found_;
  std::vector<const CauseType*> candidates_;
};

std::vector<CompassSearch::Trial> CompassSearch::trials_beside(
    const std::vector<Effect>& set) const {
  std::vector<std::vector<Effect>> each(candidates_.size());
  tbb::parallel_for(std::size_t{0}, candidates_.size(), [&](std::size_t k) {
    const auto* cause = candidates_[k];
    if (std::none_of(set.begin(), set.end(), [&](const auto& e) { return e.id() == cause->id; }))
      each[k] = bench_.starts(*cause, set);
  });
  std::vector<Trial> trials;
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    for (const auto& start : each[k])
      for (std::size_t place = 0; place <= set.size(); ++place)
        trials.push_back({candidates_[k], start, place});
  return trials;
}

std::vector<Effect> CompassSearch::grown(std::vector<Effect> set, Bursts bursts) {
  double clearest = set.empty() ? 0.0 : bench_.law_of(set).gain_on(bench_.law_of({}));
  for (std::size_t step = set.size(); step <= candidates_.size(); ++step) {
    if (bursts == Bursts::hidden) bench_.find_bursts(set);
    const CompassErrors::Law before = bench_.law_of(set);
    const auto trials = trials_beside(set);
    std::vector<double> gains(trials.size(), -1e300);
    std::vector<std::vector<Effect>> fitted(trials.size());
    tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t k) {
      const auto& [cause, start, place] = trials[k];
      auto trial = set;
      trial.insert(trial.begin() + static_cast<std::ptrdiff_t>(place), start);
      trial = bench_.in_likelier_form(bench_.polished(trial));
      if (!cause->is_what_it_is_called(trial[place], bench_.conditions())) return;
      gains[k] = bench_.law_of(trial).gain_on(before) - bench_.cost(start);
      fitted[k] = std::move(trial);
    });
    const auto best = std::max_element(gains.begin(), gains.end());
    if (best == gains.end() || *best <= 0.0) break;
    const auto& likeliest = fitted[static_cast<std::size_t>(best - gains.begin())];
    // Nature's form of what is there differs from ours by as much, unless nothing is left of it.
    if (*best <= share_of_clearest * clearest &&
        *best <= std::max(clear, bench_.log_gain_of_turning(likeliest)))
      break;
    clearest = std::max(clearest, *best);
    // The lag had its form and place before what is there now was taken out.
    set = bench_.told_otherwise(likeliest);
  }
  return set;
}

/// At rest a compass repeats itself, and iron that shows while it turns looks like bursts; and
/// bursts that are fitted look like iron. So it is begun from either.
std::vector<Effect> CompassSearch::searched() {
  const auto first_bursts = grown({}, Bursts::hidden);
  bench_.forget_bursts();
  auto first_iron = grown({}, Bursts::count);
  bench_.find_bursts(first_iron);
  first_iron = grown(bench_.polished(first_iron), Bursts::hidden);
  auto set = bench_.robust_score(first_iron) > bench_.robust_score(first_bursts) ? first_iron
                                                                                 : first_bursts;
  bench_.find_bursts(set);
  return bench_.polished(set);
}

std::vector<Effect> CompassSearch::settled(std::vector<Effect> set) {
  const bool lags = std::any_of(set.begin(), set.end(), is_lag);
  if (lags)
    bench_.unshift();
  else
    bench_.shift_beside(set);
  if (set.empty()) return set;
  set = bench_.polished(set);
  for (std::size_t k = 0; k < set.size(); ++k)
    if (!is_lag(set[k])) set = bench_.in_other_form(std::move(set), k);
  bench_.find_bursts(set);
  set = bench_.polished(set);
  if (!lags) bench_.shift_beside(set);
  return set;
}

std::vector<Member> CompassSearch::members_of(std::vector<Effect>& set) {
  std::vector<Member> members;
  const double least =
      std::min(clear, share_of_clearest * bench_.law_of(set).gain_on(bench_.law_of({})));
  for (std::size_t k = 0; k < set.size();) {
    auto rest = set;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    // A shift of time may stand for the lag.
    const bool without_lag = is_lag(set[k]);
    const auto with = bench_.law_of(set);
    if (without_lag) bench_.shift_beside(rest);
    rest = bench_.polished(rest);
    // What is told otherwise may do without it.
    for (std::size_t other = 0; other < rest.size(); ++other)
      rest = bench_.in_other_form(std::move(rest), other);
    if (without_lag) bench_.shift_beside(rest);
    const double odds = with.gain_on(bench_.law_of(rest)) - bench_.cost(set[k]);
    if (without_lag && odds > least) bench_.unshift();
    if (odds <= least) {
      set = rest;
      members.clear();
      k = 0;
      continue;
    }
    members.push_back({std::string(set[k].id()), odds});
    ++k;
  }
  return members;
}

void CompassSearch::run(const SetSearchOptions& options) {
  const auto is_left_out = [&](std::string_view id) {
    return std::find(options.without.begin(), options.without.end(), id) != options.without.end();
  };
  for (const auto& cause : cause_types())
    if (cause.effect().stage() == Stage::compass && cause.id != "magnetic_bursts" &&
        !is_left_out(cause.id) && cause.why_not_assessable(bench_.conditions()).empty())
      candidates_.push_back(&cause);
  std::optional<CompassErrors::Law> on_reference;
  for (auto& effect : found_.scenario.effects)
    if (effect.id() == "time_offset") on_reference = bench_.took_clock(effect);
  auto set = settled(searched());
  auto members = members_of(set);
  const auto law = bench_.law_of(set), bare = on_reference.value_or(bench_.law_of({}));
  found_.scenario.compass.noise_std_deg = law.std_deg();
  found_.baseline.compass.noise_std_deg = bare.std_deg();
  found_.scenario.compass.initial_heading_deg = bench_.centre_deg();
  found_.baseline.compass.initial_heading_deg = bench_.centre_deg();
  const auto& bursts = bench_.bursts();
  if (bursts.per_hour > 0.0) found_.log_score_gained.reset();
  if (found_.log_score_gained) {
    *found_.log_score_gained += law.gain_on(bare);
    for (const auto& effect : set) *found_.log_score_gained -= bench_.cost(effect);
  }
  const auto burst = with_values("magnetic_bursts", {{"bursts_per_hour", bursts.per_hour},
                                                     {"mean_duration_s", bursts.duration_s},
                                                     {"std_deg", bursts.size_deg}});
  if (const double odds = bursts.gain - bench_.cost(burst);
      !is_left_out(burst.id()) && odds > 0.0) {
    set.push_back(burst);
    members.push_back({std::string(burst.id()), odds});
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
