#include <gyrostat/diagnosis/diagnosis.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/gap/ensemble.hpp>
#include <gyrostat/diagnosis/gap/scoring.hpp>
#include <gyrostat/diagnosis/lens_band.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

/// All the noise of a compass there is, where a scenario has it (with_nameless).
constexpr std::string_view nameless_compass = "empirical_compass_noise";

constexpr std::size_t fewest_samples = 1000;
constexpr std::size_t transfer_replicas = 6;

/// Of the work, as it is told.
constexpr double search_share = 0.55;

/// Replicas that say what a set lacks without one of its effects.
constexpr std::size_t lacking_replicas = 16;

/// A simulator with some of the set's effects.
struct Rung {
  std::string effect;  ///< the last of them
  Scenario scenario;
  ReplicaReadings replicas;
};

double probability_of(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

using Clock = std::chrono::steady_clock;

class Work {
 public:
  Work(const Series& recording, const DiagnosisOptions& options, const DiagnosisProgress& progress,
       const Interrupt& interrupt)
      : options_(options),
        progress_(progress),
        simulator_(recording, options.seed, interrupt),
        recording_(recording),
        observed_(simulator_.readings(recording)) {}

  Diagnosis run();

 private:
  void tell(const std::string& phase, double share, const std::string& detail = {}) {
    simulator_.interrupt().check();
    share_ = std::max(share_, share);
    if (progress_) progress_({phase, detail, share_});
  }
  void took(const std::string& part) {
    const auto now = Clock::now();
    result_.seconds.emplace_back(part, std::chrono::duration<double>(now - since_).count());
    since_ = now;
  }
  void describe(const Series& recording);
  void localise();
  /// With the drift that the recording has beside the effects.
  Scenario with_drift(Scenario scenario, const Series& recording) const;
  std::vector<Where> departures_of(const Ensemble& ensemble) const;
  void attribute();
  /// What each of the set's effects is worth: their names. Where the simulator with all of them
  /// misses the recording, its likelihood is not the recording's, and an effect without which the
  /// readings of the train part are foretold as well is the form of another one: it goes.
  std::vector<std::string> weighed(std::vector<Member> members);
  bool is_missed_by(const Rung& rung) const;
  /// Odds are those of a likelihood that is as far off as the readings of its channel say: its
  /// logarithm over their mean square deviation (quasi-likelihood; Wedderburn, Biometrika 61,
  /// 1974). What is read off the values has no likelihood of the noise.
  void temper();
  void judge_claim();
  Rung rung(const std::string& effect, const Scenario& scenario, std::size_t replicas) const;
  /// The scenario with those of the set's effects that have one of the names, its noise fitted.
  Scenario with_effects(std::vector<std::string> names);
  void add_intervals(Included& included) const;
  void climb(const std::vector<std::string>& order);
  /// What the recording still shows that the simulator, enriched, does not.
  void see_what_is_left();
  /// What effects of the rate leave is seen in the heading alone: it casts no doubt on them.
  bool only_the_compass_is_left() const;
  /// Of all ways in which the set leaves something unexplained, Bonferroni's bound.
  double p_unexplained() const;
  /// With what has no name.
  void complete();
  void measure_shrinkage();
  void keep_bands();
  void look_ahead();

  const DiagnosisOptions& options_;
  const DiagnosisProgress& progress_;
  Simulator simulator_;
  const Series& recording_;
  Readings observed_;
  std::unique_ptr<Ensemble> train_, held_out_;
  std::unique_ptr<Scoring> scoring_, held_out_scoring_;
  ReplicaReadings baseline_replicas_;
  FoundSet found_;
  std::vector<LogScore> held_out_without_;  ///< of the set without each of result_.effects
  std::map<std::vector<std::string>, Scenario> subsets_;  ///< with_effects() of what was found
  std::vector<Rung> rungs_;                               ///< one effect more each
  std::optional<Rung> completed_;                         ///< with what has no name
  Diagnosis result_;
  Clock::time_point since_ = Clock::now();
  double share_ = 0.0;  ///< told
};

void Work::describe(const Series& recording) {
  result_.samples = recording.size();
  result_.duration_s = simulator_.conditions().interval_s() * static_cast<double>(recording.size());
  result_.rate_hz = simulator_.conditions().rate_hz();
  for (const auto& channel : channels)
    if (!(recording.*channel.values).empty()) result_.channels.emplace_back(channel.name);
  for (const auto& cause : cause_types())
    if (auto why = cause.why_not_assessable(simulator_.conditions()); !why.empty())
      result_.not_assessable.push_back({std::string(cause.id), std::move(why)});
}

std::vector<Where> Work::departures_of(const Ensemble& ensemble) const {
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

void Work::localise() {
  found_ = find_set(simulator_, recording_, {.without = options_.without},
                    [this](const std::string& what, double share) {
                      tell("looking for effects", search_share * share, what);
                    });
  took("search");
  tell("simulating the baseline", search_share);
  const auto fit = linearised(simulator_, with_drift(found_.baseline, recording_));
  result_.baseline = result_.enriched = fit.scenario;
  simulator_.remember(fit.scenario, 0, 0);
  constexpr std::size_t lot = 20;
  for (std::size_t first = 0; first < options_.baseline_replicas; first += lot) {
    simulator_.remember_more(static_cast<std::uint32_t>(first),
                             std::min(lot, options_.baseline_replicas - first));
    tell("simulating the baseline",
         search_share + 0.1 * static_cast<double>(first + lot) /
                            static_cast<double>(options_.baseline_replicas));
  }
  baseline_replicas_ = simulator_.ensemble(fit.scenario, 0, options_.baseline_replicas);
  train_ = std::make_unique<Ensemble>(simulator_.instrument(Part::train), baseline_replicas_[0],
                                      fit.train_jacobian);
  held_out_ = std::make_unique<Ensemble>(simulator_.instrument(Part::held_out),
                                         baseline_replicas_[1], Eigen::MatrixXd());
  scoring_ = std::make_unique<Scoring>(*train_, observed_[0]);
  held_out_scoring_ = std::make_unique<Scoring>(*held_out_, observed_[1]);
  result_.p_after = train_->p_value(observed_[0]);
  double most_odds = found_.nameless_log_odds;
  for (const auto& m : found_.members) most_odds = std::max(most_odds, m.log_odds);
  result_.unexplained = found_.unexplained;
  constexpr double level_of_odds =
      1.0 - thresholds::level_of_lenses - thresholds::level_of_unexplained;
  result_.p_before = std::min({1.0, result_.p_after / thresholds::level_of_lenses,
                               p_unexplained() / thresholds::level_of_unexplained,
                               std::exp(-most_odds) / level_of_odds});
  result_.where = departures_of(*train_);
  took("localisation");
}

Scenario Work::with_drift(Scenario scenario, const Series& recording) const {
  const auto& conditions = simulator_.conditions();
  Scenario quiet = scenario;
  quiet.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  quiet.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  quiet.effects.clear();
  Series bare, with, left = recording;
  synthesise_rate_under(quiet, conditions.series(), {}, bare);
  for (const auto& effect : scenario.effects) {
    const auto* cause = cause_types().find(effect.id());
    if (cause != nullptr && cause->is_deterministic() && effect.stage() != Stage::compass)
      quiet.effects.push_back(effect);
  }
  synthesise_rate_under(quiet, conditions.series(), {}, with);
  for (std::size_t i = 0; i < left.size(); ++i)
    left.gyro_dps[i] -= with.gyro_dps[i] - bare.gyro_dps[i];
  left.heading_deg.clear();
  scenario.thermal_drift = fit_drift(conditions, Scene(conditions, left, train_alone));
  return scenario;
}

Rung Work::rung(const std::string& effect, const Scenario& scenario, std::size_t replicas) const {
  auto readings = simulator_.ensemble(scenario, 0, replicas);
  return {effect, scenario, std::move(readings)};
}

Scenario Work::with_effects(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  if (!options_.claim) {
    if (const auto known = subsets_.find(names); known != subsets_.end()) return known->second;
    return subsets_[names] = with_drift(found_.subset(names), recording_);
  }
  Scenario scenario = result_.enriched;
  std::erase_if(scenario.effects, [&](const auto& effect) {
    return std::find(names.begin(), names.end(), effect.id()) == names.end();
  });
  if (has(result_.enriched, nameless_compass) && !has(scenario, nameless_compass))
    scenario.compass.noise_std_deg = result_.baseline.compass.noise_std_deg;
  return scenario;
}

/// Those of the search are of the effects under the names that it fitted them by.
void Work::add_intervals(Included& included) const {
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
void Work::climb(const std::vector<std::string>& order) {
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

bool Work::is_missed_by(const Rung& rung) const {
  const Ensemble enriched(simulator_.instrument(Part::train), rung.replicas[0], {});
  return enriched.p_value(observed_[0]) < thresholds::strictness_after * options_.significance;
}

std::vector<std::string> Work::weighed(std::vector<Member> members) {
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
    const auto least =
        std::min_element(result_.effects.begin(), result_.effects.end(),
                         [](const auto& x, const auto& y) { return x.lack < y.lack; });
    if (members.size() < 2 || least->lack > 0.0 || !is_missed_by(whole)) return names;
    const auto at = least - result_.effects.begin();
    result_.enriched = without[static_cast<std::size_t>(at)].scenario;
    whole = std::move(without[static_cast<std::size_t>(at)]);
    members.erase(members.begin() + at);
  }
}

void Work::temper() {
  const Ensemble enriched(simulator_.instrument(Part::train), rungs_.back().replicas[0], {});
  const auto z = enriched.deviations(observed_[0]);
  const auto dispersion_in = [&](bool compass) {
    double squares = 0.0, count = 0.0;
    for (const auto& lens : enriched.lenses()) {
      if ((lens.channel == "heading_deg") != compass) continue;
      squares += z.segment(lens.first, lens.count).squaredNorm();
      count += static_cast<double>(lens.count);
    }
    return std::max(1.0, squares / std::max(1.0, count));
  };
  const double of_rate = dispersion_in(false), of_compass = dispersion_in(true);
  for (auto& effect : result_.effects) {
    const auto member = std::find_if(found_.members.begin(), found_.members.end(),
                                     [&](const auto& m) { return m.effect == effect.effect; });
    if (member->read_off) continue;
    const bool compass =
        cause_types().named(effect.effect, "effects").effect().stage() == Stage::compass;
    effect.log_odds /= compass ? of_compass : of_rate;
    effect.inclusion = probability_of(effect.log_odds);
  }
}

void Work::attribute() {
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
  const auto names = weighed(found_.members);
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
  const bool unexplained = (open && !only_the_compass_is_left()) || found_.nameless_log_odds > 0.0;
  result_.verdict =
      unexplained ? Verdict::unknown() : Verdict::cause(result_.effects.front().effect);
  auto& set = result_.verdict_set;
  const auto add = [&](const Verdict& verdict) {
    if (std::find(set.begin(), set.end(), verdict) == set.end()) set.push_back(verdict);
  };
  if (unexplained) add(Verdict::unknown());
  for (const auto& effect : result_.effects) add(Verdict::cause(effect.effect));
  for (const auto& rival : found_.rivals)
    if (probability_of(rival.log_odds) >= thresholds::member_probability)
      add(Verdict::cause(rival.effect));
  if (open) add(Verdict::unknown());
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

/// The claimed effects, one after another, beside the claimed random error.
void Work::judge_claim() {
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
  if (!names.empty())
    result_.verdict = Verdict::cause(names.front());
  else if (result_.p_after <= options_.significance)
    result_.verdict = Verdict::unknown();
}

void Work::see_what_is_left() {
  const Ensemble enriched(simulator_.instrument(Part::train), rungs_.back().replicas[0], {});
  result_.p_after = enriched.p_value(observed_[0]);
  result_.where_after = departures_of(enriched);
}

bool Work::only_the_compass_is_left() const {
  const auto& effects = result_.enriched.effects;
  const auto& where = result_.where_after;
  return !where.empty() && std::all_of(where.begin(), where.end(), [](const auto& w) {
    return w.channel == "heading_deg";
  }) && std::none_of(effects.begin(), effects.end(), [](const auto& effect) {
    return effect.stage() == Stage::compass;
  });
}

double Work::p_unexplained() const {
  double least = 1.0;
  for (const auto& u : found_.unexplained) least = std::min(least, u.p_value);
  return std::min(1.0, least * static_cast<double>(found_.unexplained.size()));
}

void Work::complete() {
  if (result_.verdict.is_none()) return;
  tell("modelling what has no name", 0.82);
  auto& remainder = result_.remainder;
  remainder.parts = found_.nameless(result_.enriched);
  if (remainder.parts.empty()) return;
  remainder.scenario = with_drift(with_nameless(result_.enriched, remainder.parts), recording_);
  completed_ = rung({}, remainder.scenario, options_.candidate_replicas);
}

void Work::measure_shrinkage() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto held_out = [&](const ReplicaReadings& replicas) {
    return held_out_scoring_->of(replicas[1].leftCols(
        std::min(replicas[1].cols(), static_cast<Eigen::Index>(options_.candidate_replicas))));
  };
  const auto before = held_out(baseline_replicas_);
  const auto& best = completed_       ? completed_->replicas
                     : rungs_.empty() ? baseline_replicas_
                                      : rungs_.back().replicas;
  const auto truth = held_out(best);
  result_.gap_before = result_.gap_after = gap_of(before, truth);
  result_.enrichments.push_back({"", result_.gap_before});
  const auto closed = [&](double to) {
    return result_.gap_before > 0.0 ? 1.0 - to / result_.gap_before : 0.0;
  };
  for (std::size_t k = 0; k < result_.effects.size(); ++k)
    result_.effects[k].gap_without = gap_of(held_out_without_[k], truth);
  if (completed_) {
    auto& remainder = result_.remainder;
    remainder.gap = gap_of(truth, truth);
    const Ensemble all(simulator_.instrument(Part::train), best[0], {});
    if (all.p_value(observed_[0]) < thresholds::departure)
      remainder.gap = std::max(remainder.gap, thresholds::least_left * result_.gap_before);
    remainder.closed = closed(remainder.gap);
  }
  if (rungs_.empty()) return;
  // Of an effect that closes something only beside another, nothing is made before that one.
  double least = result_.gap_before;
  for (const auto& r : rungs_) {
    const double gap = gap_of(held_out(r.replicas), truth);
    least = std::min(least, gap);
    result_.enrichments.push_back({r.effect, &r == &rungs_.back() ? gap : least});
  }
  // Where something is seen to be left, something is left.
  if (result_.p_after < thresholds::departure) {
    auto& last = result_.enrichments.back().gap;
    last = std::max(last, thresholds::least_left * result_.gap_before);
  }
  result_.gap_after = result_.enrichments.back().gap;
  for (auto& step : result_.enrichments)
    if (!step.added.empty()) step.gap = std::max(step.gap, result_.gap_after);
  result_.closed = closed(result_.gap_after);
  for (auto& cause : result_.causes) {
    tell("simulating each cause alone",
         0.83 + 0.09 * static_cast<double>(&cause - result_.causes.data()) /
                    static_cast<double>(result_.causes.size()),
         cause.effect);
    const auto alone = rung(cause.effect, cause.scenario, lacking_replicas);
    cause.gap_after = gap_of(held_out_scoring_->of(alone.replicas[1]), truth);
    cause.closed = closed(cause.gap_after);
  }
  const auto after = held_out(rungs_.back().replicas);
  // Of a right simulator, one recording in twenty shows something left: an end of an interval of
  // 95 % may be wrong half as often.
  const double most_closed =
      result_.p_after < 0.5 * thresholds::departure ? 1.0 - thresholds::least_left : 1.0;
  const auto interval = bootstrap_closed(instrument, before, after, truth, options_.seed);
  result_.closed_low = std::min(interval[0], result_.closed);
  result_.closed_high = std::max(result_.closed, std::min(interval[1], most_closed));
  if (result_.remainder.closed <= result_.closed) result_.remainder = {};
}

void Work::keep_bands() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto& last = rungs_.empty() ? baseline_replicas_[1] : rungs_.back().replicas[1];
  const Ensemble after(instrument, last, {});
  for (const auto& lens : instrument.lenses()) {
    auto band = band_of(instrument, lens);
    for (Eigen::Index i = lens.first; i < lens.first + lens.count; ++i) {
      band.observed.push_back(observed_[1][i]);
      band.before.push_back(held_out_->mean()[i]);
      band.before_spread.push_back(held_out_->spread()[i]);
      band.after.push_back(after.mean()[i]);
      band.after_spread.push_back(after.spread()[i]);
    }
    result_.bands.push_back(std::move(band));
  }
}

/// Only where something is open: a rival, or what nothing explains.
void Work::look_ahead() {
  const Cause *first = nullptr, *second = nullptr;
  const auto cause_of = [&](const std::string& effect) -> const Cause* {
    const auto at = std::find_if(result_.causes.begin(), result_.causes.end(),
                                 [&](const auto& cause) { return cause.effect == effect; });
    return at == result_.causes.end() ? nullptr : &*at;
  };
  const auto closest =
      std::max_element(found_.rivals.begin(), found_.rivals.end(),
                       [](const auto& a, const auto& b) { return a.log_odds < b.log_odds; });
  if (closest != found_.rivals.end() &&
      probability_of(closest->log_odds) >= thresholds::member_probability) {
    first = cause_of(closest->instead_of);
    second = cause_of(closest->effect);
  }
  const bool is_apart = first != nullptr && second != nullptr && first != second;
  if (!is_apart) {
    if (second != nullptr || result_.verdict.is_unknown())
      result_.next = wider_recording(simulator_.conditions(), result_.duration_s,
                                     result_.causes.empty() ? "" : result_.causes.front().effect);
    return;
  }
  tell("looking for the next experiment", 0.95);
  result_.next = next_experiment(first->scenario, second->scenario, result_.duration_s,
                                 options_.seed, simulator_.interrupt());
}

Diagnosis Work::run() {
  describe(recording_);
  localise();
  if (options_.claim)
    judge_claim();
  else
    attribute();
  if (!options_.claim) complete();
  measure_shrinkage();
  keep_bands();
  took("shrinkage");
  result_.line_sources = line_sources(recording_, result_.enriched.effects);
  tell("running the filters", 0.92);
  result_.transfer =
      transfer(simulator_, recording_, result_.baseline, result_.enriched, transfer_replicas);
  result_.portrait = portrait_of(simulator_, recording_, result_.baseline, result_.enriched);
  took("transfer");
  look_ahead();
  took("next experiment");
  tell("done", 1.0);
  return std::move(result_);
}

}  // namespace

std::vector<Effect> catalogue() {
  std::vector<Effect> all;
  for (const auto& cause : cause_types()) all.push_back(cause.effect());
  return all;
}

Diagnosis diagnose(const Series& recording, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress, const Interrupt& interrupt) {
  if (recording.size() < fewest_samples)
    throw InputError("recording", fmt::format("{} samples; at least {} are needed for a diagnosis",
                                              recording.size(), fewest_samples));
  const auto& z = recording.gyro_dps;
  const auto first = std::find_if(z.begin(), z.end(), [](double v) { return !is_missing(v); });
  if (std::all_of(first, z.end(), [&](double v) { return is_missing(v) || v == *first; }))
    throw InputError("recording", "gyro_dps never changes; there is nothing to diagnose");
  return Work(recording, options, progress, interrupt).run();
}

}  // namespace gyrostat::gap
