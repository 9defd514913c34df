#include <gyrostat/experiments/run/method_tuning.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/search/staged_search.hpp>
#include <gyrostat/experiments/run/tuning_trials.hpp>

namespace gyrostat {
namespace {

using Values = std::vector<double>;

/// How far towards the ends of the range each parameter is moved on the fresh trials.
constexpr std::array<double, 3> profile_steps = {1.0 / 16.0, 1.0 / 4.0, 1.0};
/// A growth of the measure that an engineer would not mind.
constexpr double flat_share = 0.01;

/// Four digits, as they are printed and written.
double rounded(double value, const SearchRange& range) {
  return std::clamp(std::stod(fmt::format("{:.4g}", value)), range.low, range.high);
}

/// A method's parameters, moved one by one, on the same fresh trials as the tuned ones.
class Profile {
 public:
  Profile(const std::vector<SearchRange>& ranges, const Values& tuned)
      : ranges_(ranges), tuned_(tuned) {}

  /// By parameter, side (towards low, towards high) and step.
  std::vector<Values> points() const {
    std::vector<Values> points;
    for (std::size_t i = 0; i < tuned_.size(); ++i)
      for (const double end : {0.0, 1.0})
        for (const double step : profile_steps) {
          auto& point = points.emplace_back(tuned_);
          const double from = fraction_of(ranges_[i], tuned_[i]);
          point[i] = ranges_[i].at(std::lerp(from, end, step));
        }
    return points;
  }

  /// `errors` is of the points from `at` on.
  void judge(TunedParameter& parameter, std::size_t i, const TrialMeasure& measure,
             const std::vector<Values>& errors, std::size_t at, const Values& tuned_scores) const {
    const double value = mean_of(tuned_scores);
    std::array<double, 2> edge{};
    for (std::size_t side = 0; side < 2; ++side) {
      std::array<PairedDifference, profile_steps.size()> growth;
      for (std::size_t s = 0; s < growth.size(); ++s)
        growth[s] = paired_difference(
            measure.scores(errors[at + (2 * i + side) * growth.size() + s]), tuned_scores, 1);
      (side == 0 ? parameter.at_low : parameter.at_high) = growth.back();
      parameter.matters |=
          growth.back().low > 0.0 && growth.back().mean > flat_share * std::abs(value);
      const double from = fraction_of(ranges_[i], tuned_[i]);
      edge[side] = ranges_[i].at(std::lerp(from, static_cast<double>(side), edge_of(growth)));
    }
    parameter.low = std::min(edge[0], tuned_[i]);
    parameter.high = std::max(edge[1], tuned_[i]);
  }

 private:
  static double mean_of(const Values& scores) {
    Running sums;
    for (const double score : scores) sums.add(score);
    return sums.mean;
  }

  /// The share of the way to the end from which on the growth is told. Near an optimum it is as the
  /// square of the way, its interval's half width as the way itself.
  static double edge_of(std::span<const PairedDifference> growth) {
    for (std::size_t s = 0; s < growth.size(); ++s) {
      const double lower = growth[s].low;
      if (!(lower > 0.0)) continue;
      if (s == 0) return profile_steps[0] * (growth[0].mean - lower) / growth[0].mean;
      const double before = std::min(0.0, growth[s - 1].low);
      return std::lerp(profile_steps[s - 1], profile_steps[s], before / (before - lower));
    }
    return 1.0;
  }

  const std::vector<SearchRange>& ranges_;
  const Values& tuned_;
};

/// What all of it costs, known before, for the time left.
class Progress {
 public:
  Progress(const TuningProgress& told, std::size_t search, std::size_t fresh)
      : told_(told), all_(static_cast<double>(search + fresh)) {}

  std::function<void(std::size_t)> of(std::string what, std::size_t candidates) {
    const double before = done_;
    return [this, what = std::move(what), candidates, before](std::size_t trials) {
      const double runs = before + static_cast<double>(candidates * trials);
      if (told_) told_(what, std::min(1.0, runs / all_));
    };
  }
  void add(std::size_t runs) { done_ += static_cast<double>(runs); }

 private:
  const TuningProgress& told_;
  double all_, done_ = 0.0;
};

}  // namespace

MethodTuning tune_method(const Cell& cell, std::size_t m, std::uint64_t seed,
                         const TuningGoal& goal, const RunOptions& options,
                         const TuningProgress& told) {
  const TuningTrials trials(cell, m, seed, goal.metric, options);
  const auto& method = trials.method();
  auto by_name = goal.ranges.empty() ? tuning_ranges(trials.prepared(), method) : goal.ranges;
  std::erase_if(by_name, [&](const auto& range) { return !trials.has(range.first); });
  if (by_name.empty())
    throw InputError(cell.name, method.id +
                                    " has no parameter to tune; \"tune\" in the study, or "
                                    "--range, names one with its bounds");
  std::vector<std::string> names;
  std::vector<SearchRange> ranges;
  for (const auto& [name, range] : by_name) {
    names.push_back(name);
    ranges.push_back(range);
  }
  const auto named = [&](const Values& values) {
    ParameterMap map;
    for (std::size_t i = 0; i < names.size(); ++i) map[names[i]] = values[i];
    return map;
  };
  const auto all_named = [&](const std::vector<Values>& candidates) {
    std::vector<ParameterMap> maps;
    for (const auto& values : candidates) maps.push_back(named(values));
    return maps;
  };

  MethodTuning found;
  found.method = method.id;
  Values start;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double before = trials.value_of(names[i]);
    start.push_back(std::clamp(before, ranges[i].low, ranges[i].high));
    auto& parameter = found.parameters.emplace_back();
    parameter.name = names[i];
    parameter.unit = trials.unit_of(names[i]);
    parameter.range = ranges[i];
    parameter.before = before;
  }

  const std::size_t profiled = 2 * profile_steps.size() * names.size();
  constexpr std::size_t likely_stages = 8;
  Progress progress(told, goal.budget, (2 + likely_stages + profiled) * goal.fresh);
  const auto searched = staged_search(
      ranges, start, {.runs = goal.budget, .first_trials = goal.measure.fewest(), .seed = seed},
      [&](const std::vector<Values>& candidates, std::size_t first, std::size_t last) {
        auto errors = trials.search(all_named(candidates), first, last,
                                    progress.of(method.id + ": search", candidates.size()));
        progress.add(candidates.size() * (last - first));
        return errors;
      },
      [&](std::span<const double> errors) { return goal.measure.objective(errors); });
  const auto& last = searched.stages.back();
  const auto of_search = static_cast<double>(last.trials);
  found.on_search = goal.measure.kind == TrialMeasure::Kind::probability
                        ? std::round(last.objective * of_search) / of_search
                        : last.objective;

  Values tuned = searched.values;
  for (std::size_t i = 0; i < tuned.size(); ++i) tuned[i] = rounded(tuned[i], ranges[i]);
  // All that is judged, in one pass over the fresh trials: as it was, tuned, each stage's best, and
  // the tuned one with one parameter moved.
  const Profile profile(ranges, tuned);
  std::vector<ParameterMap> judged = {{}, named(tuned)};
  for (const auto& stage : searched.stages) judged.push_back(named(stage.best));
  const std::size_t moved = judged.size();
  for (const auto& point : profile.points()) judged.push_back(named(point));
  const auto errors =
      trials.fresh(judged, 0, goal.fresh, progress.of(method.id + ": fresh trials", judged.size()));

  found.runs = searched.stages.back().runs + judged.size() * goal.fresh;
  found.before = goal.measure.of(errors[0]);
  found.after = goal.measure.of(errors[1]);
  const auto scores = goal.measure.scores(errors[1]);
  found.gain = paired_difference(goal.measure.scores(errors[0]), scores, 1);
  for (std::size_t s = 0; s < searched.stages.size(); ++s) {
    const auto& stage = searched.stages[s];
    found.curve.push_back({.what = stage.what,
                           .candidates = stage.candidates,
                           .trials = stage.trials,
                           .runs = stage.runs,
                           .fresh = goal.measure.of(errors[2 + s])});
  }
  for (std::size_t i = 0; i < tuned.size(); ++i) {
    found.parameters[i].value = tuned[i];
    profile.judge(found.parameters[i], i, goal.measure, errors, moved, scores);
  }
  return found;
}

TrialMeasure::Value measure_tuned(const Cell& cell, std::size_t method, std::uint64_t seed,
                                  const TuningGoal& goal, const ParameterMap& values,
                                  std::uint32_t first, std::uint32_t last,
                                  const RunOptions& options) {
  const TuningTrials trials(cell, method, seed, goal.metric, options);
  return goal.measure.of(trials.fresh({values}, first, last, {}).front());
}

}  // namespace gyrostat
