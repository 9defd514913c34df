#include <gyrostat/diagnosis/likelihood/compass_bench.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/likelihood/compass_step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/heading_left.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/walking_level.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {

bool is_lag(const Effect& effect) { return effect.id() == "compass_lag"; }

CompassBench::CompassBench(const Simulator& simulator, const Series& recording,
                           const Scenario& baseline)
    : simulator_(simulator),
      conditions_(simulator.conditions()),
      recording_(recording),
      baseline_(baseline),
      errors_(conditions_, recording),
      cost_of_a_value_(0.5 * std::log(static_cast<double>(recording.size()))) {
  forget_bursts();
}

CompassErrors::Law CompassBench::law_of(const std::vector<Effect>& effects) const {
  simulator_.interrupt().check();
  return errors_.law_of(effects, bursts_.hidden);
}

std::optional<CompassErrors::Law> CompassBench::took_clock(Effect& time_offset) {
  constexpr double clearly = 3.0;  // nats, for one of two clocks
  const auto before = law_of({});
  auto with = errors_;
  with.take_clock(time_offset);
  if (with.law_of({}, bursts_.hidden).gain_on(before) < clearly) return std::nullopt;
  errors_.take_clock(time_offset);
  time_offset.value(field_of(time_offset, "of_compass")) = 1.0;
  return before;
}

double CompassBench::log_gain_of_turning(const std::vector<Effect>& set) const {
  auto left = errors_.of(set);
  double seen = 0.0;
  for (const auto& span : conditions_.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (errors_.is_hidden(bursts_.hidden, i)) left[i] = no_value;
      if (!is_missing(left[i])) seen += 1.0;
    }
  const auto law = errors_.law_of_errors(left, bursts_.hidden);
  return gap::log_gain_of_turning(conditions_, left, law.level_gain,
                                  law.count / std::max(seen, 1.0));
}

void CompassBench::find_bursts(const std::vector<Effect>& effects) {
  // What a compass that trails had turned before the first sample, nobody knows.
  auto means = errors_.means_of(effects);
  const auto unknown = static_cast<std::ptrdiff_t>(std::min(trailing(effects), means.size()));
  std::fill_n(means.begin(), unknown, no_value);
  bursts_ = heading_bursts(conditions_, std::move(means), beside_turns(effects));
  std::fill_n(bursts_.hidden.begin(), unknown, 1);
}

void CompassBench::forget_bursts() {
  bursts_ = {.hidden = std::vector<char>(conditions_.slow_size(), 0)};
}

void CompassBench::shift_beside(const std::vector<Effect>& set) {
  errors_.shift_beside(set, bursts_.hidden);
}

double CompassBench::cost(const Effect& effect) const {
  const auto& cause = cause_types().named(effect.id(), "effects");
  // Bursts are seen in means of clusters.
  const double value = effect.id() == "magnetic_bursts"
                           ? 0.5 * std::log(static_cast<double>(conditions_.slow_size()))
                           : cost_of_a_value_;
  return prior + value * static_cast<double>(cause.free_parameters.size());
}

std::vector<Effect> CompassBench::starts(const CauseType& cause,
                                         const std::vector<Effect>& beside) const {
  const auto error = errors_.of(beside), plain = errors_.of({});
  Series left = recording_;
  for (std::size_t i = 0; i < left.size(); ++i) {
    left.heading_deg[i] = errors_.is_hidden(bursts_.hidden, i) || is_missing(error[i])
                              ? no_value
                              : wrap_degrees(left.heading_deg[i] + error[i] - plain[i]);
  }
  left.gyro_dps.clear();
  Evidence evidence{simulator_, recording_, Scene(conditions_, left), baseline_};
  evidence.baseline.compass.initial_heading_deg = errors_.centre_deg();
  take_undisturbed(evidence, Trace::heading);
  return cause.starts(evidence);
}

std::vector<Effect> CompassBench::polished(std::vector<Effect> set) const {
  auto left = errors_.of(set);
  auto law = errors_.law_of_errors(left, bursts_.hidden);
  const auto improve = [&](AtEnds at_ends) {
    auto better = compass_step(errors_, conditions_, bursts_.hidden, set, left,
                               WalkingLevel(law.level_gain), at_ends);
    auto its_left = errors_.of(better);
    const auto its_law = errors_.law_of_errors(its_left, bursts_.hidden);
    if (its_law.gain_on(law) <= 0.0) return false;
    set = std::move(better);
    left = std::move(its_left);
    law = its_law;
    return true;
  };
  for (int pass = 0; pass < 4; ++pass) {
    simulator_.interrupt().check();
    if (!improve(AtEnds::move) && !improve(AtEnds::stay)) break;
  }
  return set;
}

std::vector<Effect> CompassBench::in_other_form(std::vector<Effect> set, std::size_t at) const {
  auto& effect = set[at];
  const std::size_t field = field_of(effect, is_lag(effect) ? "turns_alone" : "exact");
  auto other = set;
  other[at].value(field) = 1.0 - effect.value(field);
  other = polished(other);
  return law_of(other).gain_on(law_of(set)) > 0.0 ? other : set;
}

std::vector<Effect> CompassBench::in_likelier_form(std::vector<Effect> set) const {
  const auto lag = std::find_if(set.begin(), set.end(), is_lag);
  if (set.size() < 2 || lag == set.end()) return set;
  return in_other_form(std::move(set), static_cast<std::size_t>(lag - set.begin()));
}

std::vector<Effect> CompassBench::told_otherwise(const std::vector<Effect>& set) const {
  const auto lag = std::find_if(set.begin(), set.end(), is_lag);
  // Alone, it was begun in each form.
  if (lag == set.end() || set.size() == 1) return set;
  auto forms = cause_types().named(lag->id(), "effects").told_otherwise(*lag, conditions_);
  forms.push_back(*lag);
  auto rest = set;
  rest.erase(rest.begin() + (lag - set.begin()));
  auto best = set;
  auto its_law = law_of(best);
  for (const auto& form : forms)
    for (std::size_t place = 0; place <= rest.size(); ++place) {
      auto other = rest;
      other.insert(other.begin() + static_cast<std::ptrdiff_t>(place), form);
      other = polished(std::move(other));
      if (const auto law = law_of(other); law.gain_on(its_law) > 0.0) {
        best = std::move(other);
        its_law = law;
      }
    }
  return best;
}

double CompassBench::robust_score(const std::vector<Effect>& set) const {
  const auto slow = errors_.means_of(set);
  std::vector<double> means, squares;
  for (const auto& span : conditions_.slow_spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(slow[i])) means.push_back(slow[i]);
  if (means.empty()) return 0.0;
  // The initial heading is that of no effect.
  const double centre = quantile(means, 0.5);
  for (const double mean : means) squares.push_back((mean - centre) * (mean - centre));
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

std::size_t CompassBench::trailing(const std::vector<Effect>& effects) const {
  const auto lag = std::find_if(effects.begin(), effects.end(), is_lag);
  if (lag == effects.end()) return 0;
  constexpr double memories = 5.0;
  const double trails_s = lag->value(field_of(*lag, "time_constant_s")) +
                          std::abs(lag->value(field_of(*lag, "delay_s")));
  return static_cast<std::size_t>(std::ceil(memories * trails_s / conditions_.slow_interval_s()));
}

/// Where a compass that trails does: while it turns, and until that has died out.
std::vector<char> CompassBench::beside_turns(const std::vector<Effect>& effects) const {
  std::vector<char> flags(conditions_.slow_size(), 0);
  const std::size_t reach = trailing(effects);
  if (reach == 0) return flags;
  constexpr double of_fastest = 0.05;
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

}  // namespace gyrostat::gap
