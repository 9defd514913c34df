#include "experiments/diagnosis/diagnosis.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

#include "analysis/gap/ensemble.hpp"
#include "analysis/gap/scoring.hpp"
#include "core/error.hpp"
#include "experiments/diagnosis/model_fit.hpp"

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_samples = 1000;
constexpr std::size_t screening_replicas = 8;
constexpr std::size_t fit_replicas = 3;
constexpr double needed_recovery = 0.6;   ///< less, and the cause is unknown
constexpr double needed_gain = 8.0;       ///< of log score, to name a cause where nothing stands out
constexpr double needed_gain_of_gap = 4.0;  ///< and where the gap is significant
constexpr double member_probability = 0.05;

using Clock = std::chrono::steady_clock;

/// A start, or what became of it, with its replicas' readings and its score.
struct Contender {
  std::string effect;
  Scenario scenario;
  ReplicaReadings replicas;
  LogScore score;
  std::size_t parameters = 0;
  double before = 0.0;     ///< the score of what it was added to
  double baseline = 0.0;   ///< the baseline's score
  double most_gain = 0.0;  ///< more is not the effect's
  bool misnamed = false;   ///< its parameters are not what its name says

  double gain() const {
    return std::min(score.value - before, most_gain) - (misnamed ? 1e6 : 0.0);
  }
};

/// Share of the log score beyond `from` that a simulator has of what a true one would have.
double recovered(const Contender& c, double from) {
  return (c.score.value - from) / std::max(1e-9, c.score.expected - from);
}

bool same_walk(const Arima111<double>& a, const Arima111<double>& b) {
  return a.phi == b.phi && a.delta1_dps == b.delta1_dps && a.delta2_dps == b.delta2_dps;
}

bool same_drift(const ThermalDrift<double>& a, const ThermalDrift<double>& b) {
  return a.a_dps_per_C == b.a_dps_per_C && a.b_dps_s_per_C == b.b_dps_s_per_C && a.c_dps == b.c_dps;
}

/// The base with a start's effect. A first effect has what is left beside it as its random error and
/// drift. A further one is tried with the base's, too, and with a random walk that is its own: the
/// base's may have stood in for it.
std::vector<Scenario> with_start(const Scenario& baseline, const Scenario& base, const Start& start) {
  std::vector<Scenario> tried;
  const auto add = [&](const Arima111<double>& random_error, const ThermalDrift<double>& drift) {
    Scenario scenario = base;
    scenario.random_error = random_error;
    scenario.thermal_drift = drift;
    scenario.effects.push_back(start.effect);
    tried.push_back(scenario);
  };
  const auto& rest = start.rest;
  if (base.effects.empty()) {
    add(rest.random_error, rest.thermal_drift);
    return tried;
  }
  add(base.random_error, base.thermal_drift);
  if (same_walk(rest.random_error, baseline.random_error)) return tried;
  auto own_walk = rest.random_error;
  own_walk.measurement_noise_std_dps = base.random_error.measurement_noise_std_dps;
  add(own_walk, base.thermal_drift);
  if (!same_drift(rest.thermal_drift, base.thermal_drift)) add(own_walk, rest.thermal_drift);
  return tried;
}

class Work {
 public:
  Work(const Series& recording, const DiagnosisOptions& options, const DiagnosisProgress& progress)
      : options_(options),
        progress_(progress),
        simulator_(recording, options.seed),
        evidence_{simulator_, recording, Scene(simulator_.conditions(), recording), {}, 0.0},
        observed_(simulator_.readings(recording)) {}

  Diagnosis run();

 private:
  void tell(const std::string& what, double share) {
    if (progress_) progress_(what, share);
  }
  void took(const std::string& part) {
    const auto now = Clock::now();
    result_.seconds.emplace_back(part, std::chrono::duration<double>(now - since_).count());
    since_ = now;
  }
  void describe(const Series& recording);
  void localise();
  std::vector<Where> departures_of(const Ensemble& ensemble) const;
  void find_starts();
  std::vector<Contender> contend(const Scenario& base, const std::vector<std::string>& taken);
  double score_of(const ReplicaReadings& of, std::size_t replicas) const;
  Contender judged(const std::string& effect, const Scenario& scenario, std::size_t replicas,
                   double most_gain);
  void attribute();
  void judge_claim();
  void measure_shrinkage();
  void keep_bands();
  void look_ahead();

  const DiagnosisOptions& options_;
  const DiagnosisProgress& progress_;
  Simulator simulator_;
  Evidence evidence_;
  Readings observed_;
  std::unique_ptr<Ensemble> train_, held_out_;
  std::unique_ptr<Scoring> scoring_, held_out_scoring_;
  ReplicaReadings baseline_replicas_;
  std::vector<std::pair<std::string, std::vector<Start>>> starts_;  ///< of every assessable effect
  std::vector<Contender> added_;   ///< accepted, in order
  std::vector<LogScore> held_out_scores_;  ///< of result_.causes, in their order
  Diagnosis result_;
  Clock::time_point since_ = Clock::now();
};

void Work::describe(const Series& recording) {
  result_.samples = recording.size();
  result_.duration_s = simulator_.conditions().interval_s() * static_cast<double>(recording.size());
  result_.rate_hz = simulator_.conditions().rate_hz();
  for (const auto& channel : channels)
    if (!(recording.*channel.values).empty()) result_.channels.emplace_back(channel.name);
  for (const auto& effect : catalogue())
    if (auto why = why_not_assessable(effect, simulator_.conditions()); !why.empty())
      result_.not_assessable.push_back({std::string(Effects::id_of(effect)), std::move(why)});
}

std::vector<Where> Work::departures_of(const Ensemble& ensemble) const {
  std::vector<Where> found;
  const auto& instrument = simulator_.instrument(Part::train);
  for (const auto& departure : ensemble.departures(observed_[0], 0.05)) {
    const auto lens = std::find_if(instrument.lenses().begin(), instrument.lenses().end(),
                                   [&](const LensView& l) {
                                     return departure.reading >= l.first &&
                                            departure.reading < l.first + l.count;
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
  tell("fitting the baseline", 0.02);
  const auto fit = fit_baseline(simulator_, evidence_.scene, evidence_.recording);
  evidence_.baseline = result_.baseline = result_.enriched = fit.scenario;
  evidence_.white_std_dps = evidence_.scene.octaves[0].empty()
                                ? fit.scenario.random_error.measurement_noise_std_dps
                                : std::sqrt(0.5 * evidence_.scene.octaves[0][0].mean_square);
  took("baseline fit");
  tell("simulating the baseline", 0.05);
  simulator_.remember(fit.scenario, 0, options_.baseline_replicas);
  simulator_.remember_more(judging_replicas, fit_replicas);
  baseline_replicas_ = simulator_.ensemble(fit.scenario, 0, options_.baseline_replicas);
  train_ = std::make_unique<Ensemble>(simulator_.instrument(Part::train), baseline_replicas_[0],
                                      fit.train_jacobian);
  held_out_ = std::make_unique<Ensemble>(simulator_.instrument(Part::held_out),
                                         baseline_replicas_[1], Eigen::MatrixXd());
  scoring_ = std::make_unique<Scoring>(*train_, observed_[0]);
  held_out_scoring_ = std::make_unique<Scoring>(*held_out_, observed_[1]);

  result_.p_before = train_->p_value(observed_[0]);
  result_.where = departures_of(*train_);
  took("localisation");
}

/// By its first replicas. Few replicas tell a mean and a spread less well and score lower, so two
/// simulators are compared by as many of the same noise.
double Work::score_of(const ReplicaReadings& of, std::size_t replicas) const {
  return scoring_->of(of[0].leftCols(std::min(of[0].cols(), static_cast<Eigen::Index>(replicas)))).value;
}

/// A scenario whose last effect has just been added.
Contender Work::judged(const std::string& effect, const Scenario& scenario, std::size_t replicas,
                       double most_gain) {
  Contender c{.effect = effect, .scenario = scenario,
              .replicas = simulator_.ensemble(scenario, 0, replicas), .score = {}};
  c.score = scoring_->of(c.replicas[0]);
  c.baseline = score_of(baseline_replicas_, replicas);
  c.before = added_.empty() ? c.baseline : score_of(added_.back().replicas, replicas);
  c.most_gain = most_gain;
  c.misnamed = !is_what_it_is_called(scenario.effects.back(), simulator_.conditions());
  for (const auto& any : scenario.effects) c.parameters += free_parameters(any).size();
  return c;
}

void Work::find_starts() {
  std::vector<Effects::Any> assessable;
  for (const auto& effect : catalogue()) {
    const auto& without = options_.without;
    if (std::find(without.begin(), without.end(), Effects::id_of(effect)) == without.end() &&
        why_not_assessable(effect, simulator_.conditions()).empty())
      assessable.push_back(effect);
  }
  starts_.resize(assessable.size());
  tbb::parallel_for(std::size_t{0}, assessable.size(), [&](std::size_t k) {
    starts_[k] = {std::string(Effects::id_of(assessable[k])), starts(assessable[k], evidence_)};
  });
  took("starts");
}

std::vector<Contender> Work::contend(const Scenario& base, const std::vector<std::string>& taken) {
  std::vector<Contender> screened;
  double done = 0.0;
  for (const auto& [effect, its_starts] : starts_) {
    done += 1.0 / static_cast<double>(starts_.size());
    if (std::find(taken.begin(), taken.end(), effect) != taken.end()) continue;
    tell(fmt::format("trying {}", effect), 0.2 + 0.3 * done);
    std::vector<Contender> tried;
    for (const auto& start : its_starts)
      for (const auto& scenario : with_start(result_.baseline, base, start))
        tried.push_back(judged(effect, scenario, screening_replicas, start.most_gain));
    if (tried.empty()) continue;
    screened.push_back(*std::max_element(tried.begin(), tried.end(), [](const auto& a, const auto& b) {
      return a.gain() < b.gain();
    }));
  }
  for (const auto& c : screened)
    result_.screening.emplace_back(c.effect, c.gain());
  took("screening");

  std::sort(screened.begin(), screened.end(),
            [](const auto& a, const auto& b) { return a.gain() > b.gain(); });
  const double leader = screened.empty() ? 0.0 : screened.front().gain();
  const double reach = std::max(15.0, 0.4 * (leader + (screened.empty() ? 0.0 : screened.front().before - screened.front().baseline)));
  std::size_t kept = 0;
  while (kept < std::min(screened.size(), options_.shortlist) &&
         (kept < 2 || screened[kept].gain() > leader - reach))
    ++kept;
  screened.resize(kept);
  for (std::size_t k = 0; k < screened.size(); ++k) {
    tell(fmt::format("fitting {}", screened[k].effect),
         0.5 + 0.4 * static_cast<double>(k) / static_cast<double>(screened.size()));
    const auto& start = screened[k];
    const auto fitted = judged(start.effect,
                               refine(simulator_, start.scenario, observed_[0],
                                      scoring_->spread(start.replicas[0]), 3, fit_replicas),
                               screening_replicas, start.most_gain);
    const auto& better = fitted.gain() > start.gain() ? fitted : start;
    screened[k] = judged(better.effect, better.scenario, options_.candidate_replicas, better.most_gain);
  }
  std::sort(screened.begin(), screened.end(), [](const auto& a, const auto& b) {
    return a.gain() - a.score.penalty(a.parameters) > b.gain() - b.score.penalty(b.parameters);
  });
  took("fitting");
  return screened;
}

void Work::attribute() {
  find_starts();
  const auto ranked = contend(result_.baseline, {});
  std::vector<double> scores;
  for (const auto& c : ranked) scores.push_back(c.gain() - c.score.penalty(c.parameters));
  const bool significant = result_.p_before <= options_.significance;
  const bool gained =
      !ranked.empty() && scores.front() > (significant ? needed_gain_of_gap : needed_gain);
  if (!gained) {
    result_.verdict = significant ? "unknown" : "none";
    if (result_.verdict == "unknown") result_.verdict_set = {"unknown"};
    return;
  }
  const double best = scores.front();
  double total = 0.0;
  for (const double s : scores) total += std::exp((s - best) / Scoring::temperature);
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    const auto& c = ranked[k];
    Cause cause{.effect = c.effect, .scenario = c.scenario,
                .log_score = scores[k]};
    cause.recovered = recovered(c, c.baseline);
    cause.probability = std::exp((scores[k] - best) / Scoring::temperature) / total;
    result_.causes.push_back(cause);
    held_out_scores_.push_back(held_out_scoring_->of(c.replicas[1]));
  }
  added_.push_back(ranked.front());
  const double by_chance = static_cast<double>(catalogue().size()) *
                           std::exp(-best / Scoring::temperature);
  result_.p_before = std::min(result_.p_before, by_chance);

  // More effects, while the log score gains what a true cause would. In a long recording, where
  // trying takes time, only while something is seen to be left.
  const bool is_long = result_.samples > 200'000;
  const int most = is_long ? std::min(options_.most_effects, 2) : options_.most_effects;
  while (static_cast<int>(added_.size()) < most) {
    const auto& last = added_.back();
    if (is_long && last.score.deficit() < 4.0) break;
    std::vector<std::string> taken;
    for (const auto& c : added_) taken.push_back(c.effect);
    const auto next = contend(last.scenario, taken);
    if (next.empty()) break;
    const auto& c = next.front();
    const double gain = c.gain() - c.score.penalty(c.parameters - last.parameters);
    if (gain < std::max(needed_gain, 0.12 * (last.score.expected - last.score.value))) break;
    added_.push_back(c);
    Cause cause{.effect = c.effect, .scenario = c.scenario, .log_score = gain};
    cause.recovered = recovered(c, c.before);
    cause.probability = 1.0 - 1.0 / (1.0 + std::exp(std::min(50.0, gain / Scoring::temperature)));
    result_.causes.push_back(cause);
    held_out_scores_.push_back(held_out_scoring_->of(c.replicas[1]));
  }
  result_.enriched = added_.back().scenario;

  const auto& final = added_.back();
  const double share = recovered(final, final.baseline);
  const bool unexplained = share < needed_recovery && final.score.deficit() > 4.0;
  result_.verdict = unexplained ? "unknown" : result_.causes.front().effect;
  if (unexplained)
    for (auto& cause : result_.causes) cause.probability *= std::clamp(share, 0.0, 1.0);
  for (const auto& cause : result_.causes)
    if (cause.probability >= member_probability) result_.verdict_set.push_back(cause.effect);
  if (unexplained) result_.verdict_set.insert(result_.verdict_set.begin(), "unknown");
}

/// The claimed effects, one after another, beside the claimed random error.
void Work::judge_claim() {
  Scenario scenario = result_.baseline;
  scenario.random_error = options_.claim->random_error;
  for (const auto& effect : options_.claim->effects) {
    const std::string name(Effects::id_of(effect));
    tell("judging " + name, 0.6);
    scenario.effects.push_back(effect);
    added_.push_back(judged(name, scenario, options_.candidate_replicas, std::numeric_limits<double>::infinity()));
    const auto& c = added_.back();
    Cause cause{.effect = name, .scenario = scenario, .log_score = c.gain()};
    cause.recovered = recovered(c, c.before);
    cause.probability = 1.0;
    result_.causes.push_back(cause);
    held_out_scores_.push_back(held_out_scoring_->of(c.replicas[1]));
    result_.verdict_set.push_back(name);
  }
  result_.enriched = added_.back().scenario;
  result_.verdict = added_.front().effect;
  result_.claimed = true;
}

void Work::measure_shrinkage() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto before = held_out_scoring_->of(baseline_replicas_[1]);
  const auto truth = added_.empty() ? before : held_out_scoring_->of(added_.back().replicas[1]);
  result_.gap_before = result_.gap_after = gap_of(before, truth);
  result_.p_after = result_.p_before;
  result_.steps.push_back({"", result_.gap_before});
  const auto closed = [&](double to) {
    return result_.gap_before > 0.0 ? 1.0 - to / result_.gap_before : 0.0;
  };
  for (std::size_t k = 0; k < result_.causes.size(); ++k) {
    result_.causes[k].gap_after = gap_of(held_out_scores_[k], truth);
    result_.causes[k].closed = closed(result_.causes[k].gap_after);
  }
  if (added_.empty()) return;
  for (const auto& c : added_)
    result_.steps.push_back({c.effect, gap_of(held_out_scoring_->of(c.replicas[1]), truth)});
  result_.gap_after = result_.steps.back().gap;
  result_.closed = closed(result_.gap_after);
  const Ensemble enriched(simulator_.instrument(Part::train), added_.back().replicas[0], {});
  result_.p_after = enriched.p_value(observed_[0]);
  result_.where_after = departures_of(enriched);
  const auto interval = bootstrap_closed(instrument, before, truth, truth, options_.seed);
  result_.closed_low = interval[0];
  result_.closed_high = interval[1];
}

void Work::keep_bands() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto& last = added_.empty() ? baseline_replicas_[1] : added_.back().replicas[1];
  const Ensemble after(instrument, last, {});
  for (const auto& lens : instrument.lenses()) {
    Band band{.lens = std::string(lens.id), .title = std::string(lens.title),
              .channel = std::string(lens.channel), .coordinate = std::string(lens.coordinate),
              .unit = std::string(lens.unit), .at = {}, .observed = {}, .before = {},
              .before_spread = {}, .after = {}, .after_spread = {}};
    for (Eigen::Index i = lens.first; i < lens.first + lens.count; ++i) {
      const auto& at = instrument.at()[static_cast<std::size_t>(i)];
      const bool open = at.to > 1e8;  // "so much and more"
      band.at.push_back(open ? at.from : 0.5 * (at.from + at.to));
      band.observed.push_back(observed_[1][i]);
      band.before.push_back(held_out_->mean()[i]);
      band.before_spread.push_back(held_out_->spread()[i]);
      band.after.push_back(after.mean()[i]);
      band.after_spread.push_back(after.spread()[i]);
    }
    result_.bands.push_back(std::move(band));
  }
}

/// Only where the verdict does not stand alone.
void Work::look_ahead() {
  std::vector<const Cause*> rivals;
  for (const auto& cause : result_.causes)
    if (cause.scenario.effects.size() == 1 && cause.probability >= member_probability)
      rivals.push_back(&cause);
  if (rivals.size() < 2) return;
  tell("looking for the next experiment", 0.95);
  result_.next = next_experiment(rivals[0]->scenario, rivals[1]->scenario, result_.duration_s, options_.seed);
}

Diagnosis Work::run() {
  describe(evidence_.recording);
  localise();
  if (options_.claim) judge_claim();
  else attribute();
  measure_shrinkage();
  keep_bands();
  took("shrinkage");
  tell("running the filters", 0.92);
  result_.transfer = transfer(simulator_, evidence_.recording, result_.baseline, result_.enriched, 6);
  took("transfer");
  look_ahead();
  took("next experiment");
  tell("done", 1.0);
  return std::move(result_);
}

}  // namespace

std::vector<Effects::Any> catalogue() {
  std::vector<Effects::Any> all;
  Effects::for_each([&]<class Entry>(Entry /*entry*/) { all.emplace_back(typename Entry::type{}); });
  return all;
}

Diagnosis diagnose(const Series& recording, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress) {
  if (recording.size() < fewest_samples)
    throw InputError("recording", fmt::format("{} samples; at least {} are needed for a diagnosis",
                                              recording.size(), fewest_samples));
  const auto& z = recording.gyro_dps;
  const auto first = std::find_if(z.begin(), z.end(), [](double v) { return !is_missing(v); });
  if (std::all_of(first, z.end(), [&](double v) { return is_missing(v) || v == *first; }))
    throw InputError("recording", "gyro_dps never changes; there is nothing to diagnose");
  if (options.claim && options.claim->effects.empty())
    throw InputError("claim", "its scenario has no effects; there is nothing to judge");
  return Work(recording, options, progress).run();
}

}  // namespace gyrostat::gap
