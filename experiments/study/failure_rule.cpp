#include <gyrostat/experiments/study/failure_rule.hpp>

#include <cmath>
#include <limits>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/study/chosen_methods.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/experiments/study/study_ranges.hpp>

namespace gyrostat {

double FailureRule::badness(double value) const {
  if (std::isnan(value)) return std::numeric_limits<double>::infinity();
  return above ? value : -value;
}

FailureRule read_failure(JsonObject object, const Cell& cell) {
  if (cell.recording)
    throw InputError(object.place(), "the pieces of a recording have no noise to look for it in");
  FailureRule rule;
  rule.metric =
      metric_named(object.required_text("metric", metric_types().ids()), object.place_of("metric"));
  const auto unit = std::string(metric_types()[rule.metric].unit);
  if (object.has("above") == object.has("below"))
    throw InputError(object.place(), "either \"above\" or \"below\" is needed here");
  rule.above = object.has("above");
  rule.threshold = object.number(rule.above ? "above" : "below", 0.0, ranges::any, unit);
  rule.methods = chosen_methods(object, "methods", cell);
  const auto whole = [&](const char* key, std::uint32_t fallback, const Range& range) {
    return static_cast<std::uint32_t>(object.number(key, fallback, range, ""));
  };
  rule.runs = whole("runs", rule.runs, study_ranges::runs);
  rule.samples = whole("samples", rule.samples, study_ranges::level_samples);
  rule.levels = whole("levels", rule.levels, study_ranges::subset_levels);
  object.finish();
  return rule;
}

}  // namespace gyrostat
