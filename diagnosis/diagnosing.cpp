#include <gyrostat/diagnosis/diagnosing.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/nameless_mean.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/truncation.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>
#include <gyrostat/diagnosis/significance.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>
#include <gyrostat/diagnosis/views.hpp>
#include <gyrostat/generators/effects/quantization.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t transfer_replicas = 6;

std::optional<Transient> clearest_of(const std::array<std::optional<Transient>, 2>& parts) {
  std::optional<Transient> clearest;
  for (const auto& transient : parts)
    if (transient && transient->p_value < thresholds::p_of_the_unexplained &&
        (!clearest || transient->p_value < clearest->p_value))
      clearest = transient;
  return clearest;
}

}  // namespace

void Diagnosing::tell(const std::string& phase, double share, const std::string& detail) {
  simulator_.interrupt().check();
  share_ = std::max(share_, share);
  if (progress_) progress_({phase, detail, share_});
}

void Diagnosing::took(const std::string& part) {
  const auto now = std::chrono::steady_clock::now();
  result_.seconds.emplace_back(part, std::chrono::duration<double>(now - since_).count());
  since_ = now;
}

void Diagnosing::describe(const Series& recording) {
  result_.samples = recording.size();
  result_.duration_s = simulator_.conditions().interval_s() * static_cast<double>(recording.size());
  result_.rate_hz = simulator_.conditions().rate_hz();
  for (const auto& channel : channels)
    if (!(recording.*channel.values).empty()) result_.channels.emplace_back(channel.name);
  for (const auto& cause : cause_types())
    if (auto why = cause.why_not_assessable(simulator_.conditions()); !why.empty())
      result_.not_assessable.push_back({std::string(cause.id), std::move(why)});
}

const FoundSet& Diagnosing::search() {
  if (!std::exchange(has_searched_, true)) {
    found_ = find_set(simulator_, recording_, {.without = options_.without},
                      [this](const std::string& what, double share) {
                        tell(looking_, search_share * share, what);
                      });
    took("search");
  }
  return found_;
}

void Diagnosing::take(const std::vector<Given>& given) {
  if (given.empty() || !search().beside) return;
  looking_ = "looking beside what the axes have alike";
  found_ = found_.beside(given);
  given_ = given;
  took("search with the other axes");
}

void Diagnosing::localise() {
  for (const auto part : both_parts)
    if (simulator_.instrument(part).size() == 0)
      throw InputError("recording", fmt::format("too few samples are there in the part that {} to "
                                                "read anything off them",
                                                part == Part::train ? "causes are looked for in"
                                                                    : "is held back"));
  search();
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
  result_.transient = clearest_of(found_.transients);
  result_.log_score_gained = found_.log_score_gained;
  result_.p_before =
      p_of_the_clearest(result_.p_after, p_of_the_oddest(found_.unexplained), most_odds);
  result_.where = result_.where_after = departures_of(*train_);
  took("localisation");
}

Scenario Diagnosing::with_drift(Scenario scenario, const Series& recording) const {
  const auto& conditions = simulator_.conditions();
  Scenario quiet = scenario;
  quiet.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  quiet.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  quiet.effects.clear();
  Series bare, with, left = recording;
  for (const auto& effect : scenario.effects)
    if (const auto* grid = effect.as<effects::Quantization>();
        grid != nullptr && grid->towards_zero != 0.0)
      left.gyro_dps = middles_of_cut_off(conditions, left.gyro_dps, grid->lsb_dps);
  // The mean of rounded values is not what was rounded.
  if (!found_.before_rounding_dps.empty() && has(scenario, "quantization"))
    left.gyro_dps = found_.before_rounding_dps;
  synthesise_rate_under(quiet, conditions.series(), {}, bare);
  for (const auto& effect : scenario.effects) {
    const auto* cause = cause_types().find(effect.id());
    if ((cause != nullptr && cause->is_deterministic() && effect.stage() != Stage::compass) ||
        is_mean_without_name(effect))
      quiet.effects.push_back(effect);
  }
  synthesise_rate_under(quiet, conditions.series(), {}, with);
  for (std::size_t i = 0; i < left.size(); ++i)
    left.gyro_dps[i] -= with.gyro_dps[i] - bare.gyro_dps[i];
  left.heading_deg.clear();
  scenario.thermal_drift = fit_drift(conditions, Scene(conditions, left, train_alone));
  if (found_.level_on_grid_dps && has(scenario, "quantization"))
    scenario.thermal_drift = {
        .a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = *found_.level_on_grid_dps};
  return scenario;
}

Rung Diagnosing::rung(const std::string& effect, const Scenario& scenario,
                      std::size_t replicas) const {
  auto readings = simulator_.ensemble(scenario, 0, replicas);
  return {effect, scenario, std::move(readings)};
}

Scenario Diagnosing::with_effects(std::vector<std::string> names) {
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

/// Only where something is open: a rival, or what nothing explains.
void Diagnosing::look_ahead() {
  std::optional<Scenario> first, second;
  const auto scenario_of = [&](const std::string& effect) -> std::optional<Scenario> {
    const auto at = std::find_if(result_.causes.begin(), result_.causes.end(),
                                 [&](const auto& cause) { return cause.effect == effect; });
    return at == result_.causes.end() ? std::nullopt : std::optional(at->scenario);
  };
  const auto closest =
      std::max_element(found_.rivals.begin(), found_.rivals.end(),
                       [](const auto& a, const auto& b) { return a.log_odds < b.log_odds; });
  if (closest != found_.rivals.end() &&
      probability_of(closest->log_odds) >= thresholds::member_probability) {
    first = scenario_of(closest->instead_of);
    second = scenario_of(closest->effect);
    // What may be there or not is held against nothing in its place.
    if (closest->instead_of.empty() && second) {
      first = second;
      first->effects.clear();
    }
  }
  if (!first || !second || closest->instead_of == closest->effect) {
    const auto& set = result_.verdict_set;
    const bool may_be_unknown = std::find(set.begin(), set.end(), Verdict::unknown()) != set.end();
    const std::string nearest = result_.causes.empty() ? "" : result_.causes.front().effect;
    if (result_.transient)
      result_.next = undisturbed_recording(nearest);
    else if (second || may_be_unknown)
      result_.next = wider_recording(simulator_.conditions(), result_.duration_s, nearest,
                                     is_left_in_the_compass_alone());
    return;
  }
  tell("looking for the next experiment", 0.95);
  result_.next =
      next_experiment(*first, *second, result_.duration_s, options_.seed, simulator_.interrupt());
}

Diagnosis Diagnosing::run() {
  describe(recording_);
  localise();
  if (options_.claim)
    judge_claim();
  else
    attribute();
  if (!options_.claim) {
    result_.detectable = found_.detectable();
    took("detectable");
    complete();
  }
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
  return std::move(result_);
}

}  // namespace gyrostat::gap
