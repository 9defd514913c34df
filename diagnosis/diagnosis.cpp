#include <gyrostat/diagnosis/diagnosis.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/contest.hpp>
#include <gyrostat/diagnosis/gap/ensemble.hpp>
#include <gyrostat/diagnosis/gap/scoring.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_samples = 1000;
constexpr std::size_t transfer_replicas = 6;

/// Of each log score among all of them and `none`, the score of there being nothing.
std::vector<double> probabilities(const std::vector<double>& scores, double none) {
  const double best = std::max(none, *std::max_element(scores.begin(), scores.end()));
  double total = std::exp((none - best) / Scoring::temperature);
  std::vector<double> shares;
  for (const double s : scores) shares.push_back(std::exp((s - best) / Scoring::temperature));
  for (const double share : shares) total += share;
  for (double& share : shares) share /= total;
  return shares;
}

using Clock = std::chrono::steady_clock;

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
  void attribute();
  /// A cause whose score is counted from `from`.
  void keep(const Contender& c, double log_score, double from, double probability);
  void judge_claim();
  /// What the recording still shows that the simulator, enriched, does not.
  void see_what_is_left();
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
  std::unique_ptr<Contest> contest_;
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
  contest_ = std::make_unique<Contest>(
      evidence_, *scoring_, observed_[0], baseline_replicas_, options_,
      [this](const std::string& what, double share) { tell(what, share); },
      [this](const std::string& part) { took(part); });
  result_.p_before = result_.p_after = train_->p_value(observed_[0]);
  result_.where = departures_of(*train_);
  took("localisation");
}

void Work::keep(const Contender& c, double log_score, double from, double probability) {
  result_.causes.push_back({.effect = c.effect,
                            .scenario = c.scenario,
                            .log_score = log_score,
                            .recovered = recovered(c, from),
                            .probability = probability});
  held_out_scores_.push_back(held_out_scoring_->of(c.replicas[1]));
}

void Work::attribute() {
  const auto ranked = contest_->contend();
  std::vector<double> scores;
  for (const auto& c : ranked) scores.push_back(c.gain() - c.score.penalty(c.parameters));
  const bool significant = result_.p_before <= options_.significance;
  const bool gained = !ranked.empty() &&
                      scores.front() > (significant ? thresholds::gain_of_gap : thresholds::gain);
  if (!gained) {
    if (!significant) return;
    result_.verdict = Verdict::unknown();
    result_.verdict_set = {Verdict::unknown()};
    return;
  }
  const auto shares = probabilities(scores, -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < ranked.size(); ++k)
    keep(ranked[k], scores[k], ranked[k].baseline, shares[k]);
  contest_->add(ranked.front());
  const double by_chance =
      static_cast<double>(cause_types().size()) * std::exp(-scores.front() / Scoring::temperature);
  result_.p_before = std::min(result_.p_before, by_chance);

  // More effects, while the log score gains what a true cause would. In a long recording, where
  // trying takes time, only while something is seen to be left.
  const bool is_long = result_.samples > thresholds::long_recording;
  const int most = is_long ? std::min(options_.most_effects, thresholds::most_effects_of_long)
                           : options_.most_effects;
  while (static_cast<int>(contest_->added().size()) < most) {
    const auto& last = contest_->added().back();
    if (is_long && last.score.deficit() < thresholds::deficit_of_a_miss) break;
    const auto next = contest_->contend();
    if (next.empty()) break;
    std::vector<double> gains;
    for (const auto& c : next)
      gains.push_back(c.gain() - c.score.penalty(c.parameters - last.parameters));
    const double lack = last.score.expected - last.score.value;
    if (gains.front() < std::max(thresholds::gain, thresholds::share_of_lack * lack)) break;
    const auto likely = probabilities(gains, 0.0);
    for (std::size_t k = 0; k < next.size(); ++k)
      if (k == 0 || likely[k] >= thresholds::member_probability)
        keep(next[k], gains[k], next[k].before, likely[k]);
    contest_->add(next.front());
  }
  const auto& final = contest_->added().back();
  result_.enriched = final.scenario;
  const double share = recovered(final, final.baseline);
  see_what_is_left();
  const bool misses = final.score.deficit() > thresholds::deficit_of_a_miss ||
                      result_.p_after < thresholds::strictness_after * options_.significance;
  const bool unexplained = share < thresholds::recovery && misses;
  result_.verdict =
      unexplained ? Verdict::unknown() : Verdict::cause(result_.causes.front().effect);
  if (unexplained)
    for (auto& cause : result_.causes) cause.probability *= std::clamp(share, 0.0, 1.0);
  auto& set = result_.verdict_set;
  if (unexplained) set.push_back(Verdict::unknown());
  for (const auto& cause : result_.causes)
    if (const auto member = Verdict::cause(cause.effect);
        cause.probability >= thresholds::member_probability &&
        std::find(set.begin(), set.end(), member) == set.end())
      set.push_back(member);
}

/// The claimed effects, one after another, beside the claimed random error.
void Work::judge_claim() {
  Scenario scenario = result_.baseline;
  scenario.random_error = options_.claim->random_error;
  for (const auto& effect : options_.claim->effects) {
    const std::string name(effect.id());
    tell("judging " + name, 0.6);
    scenario.effects.push_back(effect);
    contest_->add(contest_->judged(name, scenario, options_.candidate_replicas,
                                   std::numeric_limits<double>::infinity()));
    const auto& c = contest_->added().back();
    keep(c, c.gain(), c.before, 1.0);
    result_.verdict_set.push_back(Verdict::cause(name));
  }
  result_.enriched = scenario;
  result_.verdict = Verdict::cause(contest_->added().front().effect);
  result_.claimed = true;
  see_what_is_left();
}

void Work::see_what_is_left() {
  const Ensemble enriched(simulator_.instrument(Part::train), contest_->added().back().replicas[0],
                          {});
  result_.p_after = enriched.p_value(observed_[0]);
  result_.where_after = departures_of(enriched);
}

void Work::measure_shrinkage() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto& added = contest_->added();
  const auto before = held_out_scoring_->of(baseline_replicas_[1]);
  const auto truth = added.empty() ? before : held_out_scoring_->of(added.back().replicas[1]);
  result_.gap_before = result_.gap_after = gap_of(before, truth);
  result_.enrichments.push_back({"", result_.gap_before});
  const auto closed = [&](double to) {
    return result_.gap_before > 0.0 ? 1.0 - to / result_.gap_before : 0.0;
  };
  for (std::size_t k = 0; k < result_.causes.size(); ++k) {
    result_.causes[k].gap_after = gap_of(held_out_scores_[k], truth);
    result_.causes[k].closed = closed(result_.causes[k].gap_after);
  }
  if (added.empty()) return;
  for (const auto& c : added)
    result_.enrichments.push_back({c.effect, gap_of(held_out_scoring_->of(c.replicas[1]), truth)});
  result_.gap_after = result_.enrichments.back().gap;
  result_.closed = closed(result_.gap_after);
  const auto interval = bootstrap_closed(instrument, before, truth, truth, options_.seed);
  result_.closed_low = interval[0];
  result_.closed_high = interval[1];
}

void Work::keep_bands() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto& added = contest_->added();
  const auto& last = added.empty() ? baseline_replicas_[1] : added.back().replicas[1];
  const Ensemble after(instrument, last, {});
  for (const auto& lens : instrument.lenses()) {
    Band band{.lens = std::string(lens.id),
              .title = std::string(lens.title),
              .channel = std::string(lens.channel),
              .coordinate = std::string(lens.coordinate),
              .unit = std::string(lens.unit),
              .at = {},
              .observed = {},
              .before = {},
              .before_spread = {},
              .after = {},
              .after_spread = {}};
    for (Eigen::Index i = lens.first; i < lens.first + lens.count; ++i) {
      const auto& at = instrument.at()[static_cast<std::size_t>(i)];
      band.at.push_back(at.is_open() ? at.from : 0.5 * (at.from + at.to));
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
    if (cause.scenario.effects.size() == 1 && cause.probability >= thresholds::member_probability)
      rivals.push_back(&cause);
  if (rivals.size() < 2) return;
  tell("looking for the next experiment", 0.95);
  result_.next =
      next_experiment(rivals[0]->scenario, rivals[1]->scenario, result_.duration_s, options_.seed);
}

Diagnosis Work::run() {
  describe(evidence_.recording);
  localise();
  if (options_.claim)
    judge_claim();
  else
    attribute();
  result_.screening = contest_->screening();
  measure_shrinkage();
  keep_bands();
  took("shrinkage");
  tell("running the filters", 0.92);
  result_.transfer = transfer(simulator_, evidence_.recording, result_.baseline, result_.enriched,
                              transfer_replicas);
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
