#include <gyrostat/experiments/study/stop_rule.hpp>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/study/chosen_methods.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/experiments/study/study_ranges.hpp>

namespace gyrostat {
StopRule read_stop(JsonObject object, const Cell& cell) {
  StopRule rule;
  rule.metric = metric_named(object.text("metric", std::string(judging_metric(cell))),
                             object.place_of("metric"));
  rule.at_least = static_cast<std::uint32_t>(
      object.number("at_least", 100, study_ranges::first_look, "trials"));
  const auto unit = std::string(metric_types()[rule.metric].unit);
  if (object.has("separate") == object.has("half_width_below"))
    throw InputError(object.place(), "either \"separate\" or \"half_width_below\" is needed here");
  if (object.has("separate")) {
    rule.methods = chosen_methods(object, "separate", cell);
    rule.margin = object.number("margin", 0.0, ranges::non_negative, unit);
    if (rule.methods.size() < 2)
      throw InputError(object.place_of("separate"), "at least two methods are needed here");
  } else {
    rule.half_width_below = object.number("half_width_below", 0.0, ranges::positive, unit);
    rule.methods = chosen_methods(object, "methods", cell);
  }
  object.finish();
  return rule;
}

Json with_stop(Json study, const std::string& text) {
  const auto rule = text == "none" ? Json() : Json::parse(text, nullptr, false);
  if (rule.is_discarded() || !(rule.is_null() || rule.is_object()))
    throw InputError("--stop",
                     "neither \"none\" nor JSON as a study's \"stop\", "
                     R"({"half_width_below": 0.001} or {"separate": ["kf", "stf"]})");
  if (!study.is_object() || !study.contains("cells") || !study["cells"].is_array()) return study;
  for (auto& cell : study["cells"]) {
    if (!cell.is_object()) continue;
    cell.erase("stop");
    if (rule.is_object()) cell["stop"] = rule;
  }
  return study;
}

}  // namespace gyrostat
