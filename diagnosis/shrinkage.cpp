#include <algorithm>

#include <gyrostat/diagnosis/diagnosing.hpp>
#include <gyrostat/diagnosis/lens_band.hpp>
#include <gyrostat/diagnosis/likelihood/nameless_mean.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/remainder/remainder.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {

void Diagnosing::complete() {
  if (result_.verdict.is_none()) return;
  tell("modelling what has no name", 0.82);
  auto& remainder = result_.remainder;
  const auto completed_by = [&](const std::vector<Nameless>& parts, std::size_t replicas) {
    return rung({}, with_drift(with_nameless(result_.enriched, parts), recording_), replicas);
  };
  const auto score_of = [&](const std::vector<Nameless>& parts) {
    return scoring_->of(completed_by(parts, lacking_replicas).replicas[0]).value;
  };
  remainder.parts = without_needless_means(found_.nameless(result_.enriched), score_of);
  // A name beside which a mean without one is clear may be what that mean passes for.
  if (std::any_of(remainder.parts.begin(), remainder.parts.end(),
                  [](const auto& part) { return is_mean_without_name(part.effect); }))
    cannot_rule_out(Verdict::unknown());
  if (!remainder.parts.empty())
    yardstick_ = completed_by(remainder.parts, options_.candidate_replicas);
  remainder.parts =
      with_what_replicas_lack(simulator_, recording_, result_.enriched, remainder.parts, score_of);
  if (!remainder.parts.empty())
    completed_ = completed_by(remainder.parts, options_.candidate_replicas);
  if (completed_) remainder.scenario = completed_->scenario;
}

void Diagnosing::measure_shrinkage() {
  const auto& instrument = simulator_.instrument(Part::held_out);
  const auto held_out = [&](const ReplicaReadings& replicas) {
    return held_out_scoring_->of(replicas[1].leftCols(
        std::min(replicas[1].cols(), static_cast<Eigen::Index>(options_.candidate_replicas))));
  };
  const auto before = held_out(baseline_replicas_);
  const auto& named = rungs_.empty() ? baseline_replicas_ : rungs_.back().replicas;
  const auto truth = held_out(yardstick_ ? yardstick_->replicas : named);
  result_.gap_before = result_.gap_after = gap_of(before, truth);
  result_.p_held_out = Ensemble(instrument, named[1], {}).p_value(observed_[1]);
  if (const auto& once = found_.transients[index_of(Part::held_out)])
    result_.p_held_out = std::min(1.0, 2.0 * std::min(result_.p_held_out, once->p_value));
  if (!result_.claimed && result_.p_held_out < thresholds::p_of_the_unseen) {
    cannot_rule_out(Verdict::unknown());
    if (result_.verdict.is_none()) result_.verdict = Verdict::unknown();
  }
  result_.enrichments.push_back({"", result_.gap_before});
  const auto closed = [&](double to) {
    return result_.gap_before > 0.0 ? 1.0 - to / result_.gap_before : 0.0;
  };
  for (std::size_t k = 0; k < result_.effects.size(); ++k)
    result_.effects[k].gap_without = gap_of(held_out_without_[k], truth);
  if (completed_) {
    auto& remainder = result_.remainder;
    // Neither may it be vaguer than the yardstick, nor miss what itself expects.
    const auto score = held_out(completed_->replicas);
    remainder.gap = std::max(gap_of(score, truth), gap_of(score, score));
    const Ensemble all(simulator_.instrument(Part::train), completed_->replicas[0], {});
    remainder.where = departures_of(all);
    if (all.p_value(observed_[0]) < thresholds::departure)
      remainder.gap = std::max(remainder.gap, thresholds::least_left * result_.gap_before);
    remainder.closed = closed(remainder.gap);
  }
  if (rungs_.empty()) {
    if (result_.remainder.closed <= 0.0) result_.remainder = {};
    return;
  }
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
  const auto interval = bootstrap_closed(instrument, before, after, truth, options_.seed);
  result_.closed_low = std::min(interval[0], result_.closed);
  // An end of an interval of 95 % may be wrong half as often as that: it is 1 where of recordings
  // of a right simulator one in forty shows as much, on the part that was seen and the other.
  const bool is_left = result_.p_after < 0.5 * thresholds::departure;
  result_.closed_high =
      std::max(result_.closed, is_left ? std::min(interval[1], 1.0 - thresholds::least_left)
                               : may_be_closed(after, truth) ? 1.0
                                                             : interval[1]);
  if (result_.remainder.closed <= result_.closed) result_.remainder = {};
  // Names that lead away from what they have not seen explain nothing.
  if (!result_.claimed && result_.closed_high < 0.0) {
    auto& set = result_.verdict_set;
    result_.verdict = Verdict::unknown();
    std::erase(set, result_.verdict);
    set.insert(set.begin(), result_.verdict);
  }
}

void Diagnosing::keep_bands() {
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

}  // namespace gyrostat::gap
