#include <gyrostat/diagnosis/contest.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t screening_replicas = 8;
constexpr int fit_iterations = 3;

bool same_walk(const Arima111<double>& a, const Arima111<double>& b) {
  return a.phi == b.phi && a.delta1_dps == b.delta1_dps && a.delta2_dps == b.delta2_dps;
}

bool same_drift(const ThermalDrift<double>& a, const ThermalDrift<double>& b) {
  return a.a_dps_per_C == b.a_dps_per_C && a.b_dps_s_per_C == b.b_dps_s_per_C && a.c_dps == b.c_dps;
}

/// The base with a start's effect. A first effect has what is left beside it as its random error
/// and drift. A further one is tried with the base's, too, and with a random walk that is its own:
/// the base's may have stood in for it.
std::vector<Scenario> with_start(const Scenario& baseline, const Scenario& base,
                                 const Start& start) {
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

}  // namespace

double recovered(const Contender& c, double from) {
  return (c.score.value - from) / std::max(1e-9, c.score.expected - from);
}

Contest::Contest(const Evidence& evidence, const Scoring& scoring, const Eigen::VectorXd& observed,
                 const ReplicaReadings& baseline_replicas, const DiagnosisOptions& options,
                 Tell tell, Took took)
    : evidence_(evidence),
      simulator_(evidence.simulator),
      scoring_(scoring),
      observed_(observed),
      baseline_replicas_(baseline_replicas),
      options_(options),
      tell_(std::move(tell)),
      took_(std::move(took)) {}

/// By its first replicas. Few replicas tell a mean and a spread less well and score lower, so two
/// simulators are compared by as many of the same noise.
double Contest::score_of(const ReplicaReadings& of, std::size_t replicas) const {
  return scoring_.of(of[0].leftCols(std::min(of[0].cols(), static_cast<Eigen::Index>(replicas))))
      .value;
}

Contender Contest::judged(const std::string& effect, const Scenario& scenario, std::size_t replicas,
                          double most_gain, std::span<const Part> of) const {
  Contender c{.effect = effect,
              .scenario = scenario,
              .replicas = simulator_.ensemble(scenario, 0, replicas, of),
              .score = {}};
  c.score = scoring_.of(c.replicas[0]);
  c.baseline = score_of(baseline_replicas_, replicas);
  c.before = added_.empty() ? c.baseline : score_of(added_.back().replicas, replicas);
  c.most_gain = most_gain;
  for (const auto& any : scenario.effects) {
    const auto* cause = cause_types().find(any.id());
    if (cause == nullptr) continue;  // claimed, but not in the catalogue
    c.misnamed = c.misnamed || !cause->is_what_it_is_called(any, simulator_.conditions());
    c.parameters += cause->free_parameters.size();
  }
  return c;
}

/// A fit also moves what the effect is added to, and may gain by that alone.
double Contest::score_without(const Contender& c) const {
  Scenario rest = c.scenario;
  rest.effects.pop_back();
  const auto replicas = static_cast<std::size_t>(c.replicas[0].cols());
  return score_of(simulator_.ensemble(rest, 0, replicas, train_alone), replicas);
}

void Contest::find_starts() {
  std::vector<const CauseType*> assessable;
  for (const auto& cause : cause_types()) {
    const auto& without = options_.without;
    if (std::find(without.begin(), without.end(), cause.id) == without.end() &&
        cause.why_not_assessable(simulator_.conditions()).empty())
      assessable.push_back(&cause);
  }
  starts_.resize(assessable.size());
  tbb::parallel_for(std::size_t{0}, assessable.size(), [&](std::size_t k) {
    starts_[k] = {std::string(assessable[k]->id), assessable[k]->starts(evidence_)};
  });
  took_("starts");
}

std::vector<Contender> Contest::screened() {
  const auto& base = added_.empty() ? evidence_.baseline : added_.back().scenario;
  const auto is_added = [&](const std::string& effect) {
    return std::any_of(added_.begin(), added_.end(),
                       [&](const auto& c) { return c.effect == effect; });
  };
  std::vector<Contender> best;
  double done = 0.0;
  for (const auto& [effect, its_starts] : starts_) {
    done += 1.0 / static_cast<double>(starts_.size());
    if (is_added(effect)) continue;
    tell_(fmt::format("trying {}", effect), 0.2 + 0.3 * done);
    std::vector<Contender> tried;
    for (const auto& start : its_starts)
      for (const auto& scenario : with_start(evidence_.baseline, base, start))
        tried.push_back(judged(effect, scenario, screening_replicas, start.most_gain, train_alone));
    if (tried.empty()) continue;
    best.push_back(*std::max_element(tried.begin(), tried.end(), [](const auto& a, const auto& b) {
      return a.gain() < b.gain();
    }));
  }
  for (const auto& c : best) screening_.emplace_back(c.effect, c.gain());
  took_("screening");
  return best;
}

std::vector<Contender> Contest::contend() {
  if (starts_.empty()) find_starts();
  auto best = screened();
  if (best.empty()) return best;
  std::sort(best.begin(), best.end(),
            [](const auto& a, const auto& b) { return a.gain() > b.gain(); });
  const auto& leader = best.front();
  const double least = leader.gain() - std::max(thresholds::reach_of_a_fit,
                                                thresholds::share_reach_of_a_fit *
                                                    (leader.score.value - leader.baseline));
  std::size_t kept = 0;
  while (kept < std::min(best.size(), options_.shortlist) &&
         (kept < thresholds::fewest_fitted || best[kept].gain() > least))
    ++kept;
  best.resize(kept);
  for (std::size_t k = 0; k < best.size(); ++k) {
    tell_(fmt::format("fitting {}", best[k].effect),
          0.5 + 0.4 * static_cast<double>(k) / static_cast<double>(best.size()));
    const auto& start = best[k];
    const auto fitted =
        judged(start.effect,
               refine(simulator_, start.scenario, observed_, scoring_.spread(start.replicas[0]),
                      fit_iterations, fit_replicas),
               screening_replicas, start.most_gain, train_alone);
    const auto& better = fitted.gain() > start.gain() ? fitted : start;
    best[k] = judged(better.effect, better.scenario, options_.candidate_replicas, better.most_gain);
    best[k].idle = best[k].score.value - score_without(best[k]) < thresholds::gain_of_gap;
  }
  std::sort(best.begin(), best.end(), [](const auto& a, const auto& b) {
    return a.gain() - a.score.penalty(a.parameters) > b.gain() - b.score.penalty(b.parameters);
  });
  took_("fitting");
  return best;
}

}  // namespace gyrostat::gap
