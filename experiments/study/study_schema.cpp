#include <gyrostat/experiments/study/study_schema.hpp>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study_ranges.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {
namespace {

Json number(const Range& range, std::string_view meaning) {
  Json schema = {{"type", range.whole ? "integer" : "number"}};
  if (std::isfinite(range.from))
    schema[range.open_from ? "exclusiveMinimum" : "minimum"] = range.from;
  if (std::isfinite(range.to)) schema[range.open_to ? "exclusiveMaximum" : "maximum"] = range.to;
  schema["description"] = meaning;
  return schema;
}

Json number(const Range& range, double fallback, std::string_view meaning) {
  auto schema = number(range, meaning);
  schema["default"] = fallback;
  return schema;
}

Json text(std::string_view meaning) { return {{"type", "string"}, {"description", meaning}}; }

Json one_of(const std::vector<std::string>& names, std::string_view meaning) {
  return {{"enum", names}, {"description", meaning}};
}

Json texts(std::string_view meaning) {
  return {
      {"type", "object"}, {"additionalProperties", {{"type", "string"}}}, {"description", meaning}};
}

Json list_of(const Json& items, std::string_view meaning) {
  return {{"type", "array"}, {"items", items}, {"description", meaning}};
}

Json object(const Json& properties, std::string_view meaning,
            const std::vector<std::string>& required = {}) {
  Json schema = {{"type", "object"},
                 {"description", meaning},
                 {"properties", properties},
                 {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

/// A schema for each parameter of a field list, by its name.
Json parameters(std::span<const FieldInfo> fields) {
  auto properties = Json::object();
  for (const auto& field : fields) {
    const bool has_unit = !field.unit.empty() && field.unit != "1";
    properties[field.name] =
        number(field.range, field.value,
               fmt::format("{}{}", field.doc, has_unit ? fmt::format(", {}", field.unit) : ""));
  }
  return properties;
}

Json reference(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

/// An object that names a plug-in of `Type` under `chooser` and gives its parameters beside it.
template <class Type>
Json plugin(const std::string& chooser, std::string_view meaning) {
  const auto& types = Registry<Type>::all();
  auto rules = Json::array();
  const auto add_rule = [&](std::string_view name, std::string_view title, Json properties) {
    Json allowed = {{chooser, true}};
    allowed.update(properties);
    rules.push_back(
        {{"if", {{"properties", {{chooser, {{"const", name}}}}}}},
         {"then",
          {{"description", title}, {"properties", allowed}, {"additionalProperties", false}}}});
  };
  for (const auto& type : types) add_rule(type.id, type.title, parameters(type.fields));
  return {{"type", "object"},
          {"description", meaning},
          {"required", {chooser}},
          {"properties", {{chooser, one_of(types.ids(), meaning)}}},
          {"allOf", rules}};
}

Json recording(std::string_view meaning, const Json& more) {
  Json properties = {
      {"file", text("a recording in any format, relative to the study's folder")},
      {"axis", one_of({"", "x", "y", "z"}, "of a recording with three axes")},
      {"columns", texts("columns of other names: {\"t\": \"Time[ms]\", \"gyro\": \"GyrZ\"}")},
      {"units", texts("units: {\"t\": \"ms\", \"gyro\": \"rad/s\"}")},
      {"preset",
       text("the format, of `gyrostat list formats`, where the content does not tell it")},
      {"topic", text("of a log that has several gyros")},
      {"rate_hz", number(ranges::non_negative, 0, "samples a second, for a file without times")},
      {"resample_hz", number(ranges::non_negative, 0, "put the samples on an even clock")}};
  properties.update(more);
  return object(properties, meaning, {"file"});
}

Json fit_method() { return one_of({"likelihood", "moments"}, "how parameters are fitted"); }

Json scenario() {
  auto properties = parameters(field_infos_of<Sampling>);
  properties["from_recording"] = recording(
      "random error, drift, rate and temperature from a fit to a recording; other keys override",
      {{"from_s", number(ranges::non_negative, 0, "start of the span, s from the first sample")},
       {"to_s", number(ranges::positive, "end of the span, s from the first sample")},
       {"fit", fit_method()}});
  properties["conditions_from"] = recording(
      "sampling, temperature, rates and acceleration of a recording; other keys override",
      {{"from_s", number(ranges::non_negative, 0, "start of the span, s from the first sample")},
       {"to_s", number(ranges::positive, "end of the span, s from the first sample")}});
  properties["from_fleet"] =
      object({{"file", text("the fleet, as `gyrostat diagnose A.csv B.csv ... --json` writes it, "
                            "relative to the study's folder")}},
             "each trial's random error, drift and effects drawn from the population of diagnosed "
             "sensors; other keys override",
             {"file"});
  properties["random_error"] =
      object(parameters(field_infos_of<Arima111<double>>), "ARIMA(1,1,1) and white noise");
  properties["thermal_drift"] =
      object(parameters(field_infos_of<ThermalDrift<double>>), "a T + b T' + c");
  properties["temperature"] = plugin<TemperatureType>("profile", "temperature over time");
  properties["motion"] = plugin<MotionType>("profile", "true rate over time");
  properties["cross_motion_1"] = plugin<MotionType>(
      "profile", "rate about the next axis in the order x, y, z, x; none: it is not told");
  properties["cross_motion_2"] =
      plugin<MotionType>("profile", "rate about the axis after that; none: it is not told");
  properties["acceleration"] =
      plugin<AccelerationType>("profile", "specific force over time; none: no accelerometer");
  auto compass = parameters(field_infos_of<Compass>);
  compass["disturbances"] =
      list_of(object(parameters(field_infos_of<MagneticDisturbance>), "a magnetic disturbance"),
              "periods in which something magnetic stands near the compass");
  properties["compass"] = object(compass, "a magnetic compass");
  properties["effects"] = list_of(plugin<EffectType>("effect", "a sensor effect"),
                                  "in the order they act within a stage");
  return object(properties, "what the simulated gyro does");
}

/// Bounds for each of the parameters of a filter.
Json tune(const std::string& filter, const Json& given) {
  auto properties = Json::object();
  for (const auto& [name, unused] : given.items())
    properties[name] = {{"type", "array"},
                        {"minItems", 2},
                        {"maxItems", 2},
                        {"items", reference("parameters_of_" + filter + "/properties/" + name)}};
  return object(properties, "parameters to tune, each within [low, high]");
}

Json method() {
  auto rules = Json::array();
  for (const auto& filter : filter_types()) {
    const std::string id(filter.id);
    const auto given = parameters(filter.fields);
    rules.push_back(
        {{"if", {{"properties", {{"filter", {{"const", id}}}}}, {"required", {"filter"}}}},
         {"then",
          {{"description", filter.title},
           {"properties",
            {{"parameters", reference("parameters_of_" + id)}, {"tune", tune(id, given)}}}}}});
  }
  const auto no_quotes = R"(^[^"\u0000-\u001f,:]+$)";
  auto id = text("how tables and addresses call it, where it is not the filter's name");
  id["pattern"] = no_quotes;
  const Json as_object = {
      {"type", "object"},
      {"properties",
       {{"id", id},
        {"filter", one_of(filter_types().ids(), "which filter")},
        {"parameters_from",
         one_of({"calibration", "truth", "defaults"}, "where parameters come from")},
        {"parameters", {{"type", "object"}, {"description", "parameters that are fixed"}}},
        {"tune", {{"type", "object"}, {"description", "parameters to tune"}}}}},
      {"additionalProperties", false},
      {"anyOf", {{{"required", {"filter"}}}, {{"required", {"id"}}}}},
      {"allOf", rules}};
  return {{"if", {{"type", "string"}}},
          {"then", {{"enum", filter_types().ids()}}},
          {"else", as_object}};
}

Json assumed() {
  auto properties = Json::object();
  for (const auto& filter : filter_types())
    for (const auto& field : filter.fields) properties[field.name] = {{"type", "number"}};
  return object(properties, "factors on what filters other than the oracle are told");
}

Json kind(const char* name) { return {{"properties", {{"kind", {{"const", name}}}}}}; }

Json design() {
  const auto span = object(
      {{"from",
        {{"type", "number"}, {"description", "lower end; else of the parameter's own range"}}},
       {"to",
        {{"type", "number"}, {"description", "upper end; else of the parameter's own range"}}},
       {"scale", one_of({"linear", "log"}, "what the points are even in")},
       {"levels", number(study_ranges::levels, 5, "grid: number of values")},
       {"base", {{"type", "number"}, {"description", "one_at_a_time: where the others stay"}}}},
      "a parameter's span");
  const Json values = {{"type", "array"}, {"minItems", 1}};
  const Json properties = {
      {"kind", one_of({"grid", "list", "latin_hypercube", "sobol", "one_at_a_time", "morris",
                       "saltelli", "surrogate"},
                      "how the points are placed")},
      {"parameters",
       {{"type", "object"},
        {"minProperties", 1},
        {"additionalProperties", {{"if", {{"type", "array"}}}, {"then", values}, {"else", span}}},
        {"description",
         "spans or values by path: {\"scenario.random_error.phi\": {\"from\": 0.1, \"to\": "
         "0.9}}"}}},
      {"points",
       {{"description", "list: objects {\"path\": value}; latin_hypercube, sobol: their number"},
        {"if", {{"type", "array"}}},
        {"then", {{"minItems", 1}, {"items", {{"type", "object"}, {"minProperties", 1}}}}},
        {"else", number(study_ranges::points, "number of points")}}},
      {"trajectories", number(study_ranges::points, 20, "morris: number of trajectories")},
      {"levels", number(study_ranges::levels, 4, "morris: levels of each parameter, even")},
      {"rows", number(study_ranges::points, 128, "saltelli, surrogate (32): rows of A and B")}};
  auto schema = object(properties,
                       "many cells from one: the points of a design over its parameters", {"kind"});
  schema["if"] = kind("list");
  schema["then"] = {{"required", {"points"}}};
  schema["else"] = {{"required", {"parameters"}}};
  return schema;
}

Json stop() {
  const Json names = {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}}}};
  auto methods = names, separate = names;
  methods["description"] = "whose intervals are asked for; absent: all";
  separate["description"] = "methods that are to be told apart";
  separate["minItems"] = 2;
  auto schema = object(
      {{"metric",
        one_of(metric_types().ids(), "what is looked at; else what methods are compared by")},
       {"at_least", number(study_ranges::first_look, 100, "trials at the first look")},
       {"half_width_below",
        number(ranges::positive, "of the mean's 95 % interval, in the metric's unit")},
       {"methods", methods},
       {"separate", separate},
       {"margin", number(ranges::non_negative, 0, "methods that differ by less count as equal")}},
      "when a cell has seen enough");
  schema["oneOf"] = {{{"required", {"half_width_below"}}}, {{"required", {"separate"}}}};
  return schema;
}

Json failure() {
  const Json methods = {{"type", "array"},
                        {"minItems", 1},
                        {"items", {{"type", "string"}}},
                        {"description", "whose failure is asked for; absent: all"}};
  auto schema = object(
      {{"metric", one_of(metric_types().ids(), "what fails a trial; one without a value fails")},
       {"above", number(ranges::any, "a trial fails above it, in the metric's unit")},
       {"below", number(ranges::any, "a trial fails below it, in the metric's unit")},
       {"methods", methods},
       {"runs", number(study_ranges::runs, 8, "independent runs of subset simulation")},
       {"samples", number(study_ranges::level_samples, 380, "samples of each level of a run")},
       {"levels", number(study_ranges::subset_levels, 10,
                         "levels of a run at most, each a tenth as likely as the one before")}},
      "a failure whose probability is asked for, however rare", {"metric"});
  schema["oneOf"] = {{{"required", {"above"}}}, {{"required", {"below"}}}};
  return schema;
}

Json cell() {
  auto name = text("how tables and addresses call it");
  name["pattern"] = R"(^[^"\u0000-\u001f]+$)";
  const Json properties = {
      {"name", name},
      {"trials", number(study_ranges::trials, 1000, "number of trials")},
      {"scenario", reference("scenario")},
      {"calibration",
       object({{"fit", fit_method()},
               {"each_trial", number(ranges::flag, 0, "1: a calibration for each trial")},
               {"duration_s", number(ranges::positive,
                                     "length of the calibration signal, s; else the scenario's")}},
              "how filters come by their parameters")},
      {"tuning",
       object({{"metric", one_of(metric_types().ids(), "the mean of which is made small")},
               {"trials", number(study_ranges::budget, 20, "trials that it is the mean over")},
               {"evaluations", number(study_ranges::budget, 60, "evaluations of it")},
               {"undisturbed",
                number(ranges::flag, 0, "1: on signals without magnetic disturbances")}},
              "how methods that name parameters to tune are tuned")},
      {"assumed", assumed()},
      {"denoise", number(ranges::flag, 0, "1: the rate is denoised before its error is judged")},
      {"parameters_from",
       one_of({"calibration", "truth"}, "where filters have their parameters from")},
      {"filters",
       {{"type", "array"},
        {"minItems", 1},
        {"items", method()},
        {"description", "what is tried; absent: every filter"}}},
      {"pieces", recording("a recording, calibrated on before from_s and cut into trials after it",
                           {{"from_s", number(ranges::positive, 300, "start of the pieces, s")},
                            {"duration_s", number(ranges::positive, 60, "length of a piece, s")}})},
      {"grid",
       {{"type", "object"},
        {"additionalProperties", {{"type", "array"}, {"minItems", 1}}},
        {"description",
         "a cell for each combination: {\"scenario.random_error.phi\": [0.1, 0.5]}"}}},
      {"design", design()},
      {"stop", stop()},
      {"failure", failure()}};
  return object(properties,
                "one scenario, or one recording in pieces, with the filters tried on it");
}

Json definitions() {
  Json all = {{"scenario", scenario()}, {"cell", cell()}};
  for (const auto& filter : filter_types())
    all["parameters_of_" + std::string(filter.id)] =
        object(parameters(filter.fields), "parameters that are fixed");
  return all;
}

}  // namespace

Json study_schema() {
  auto cells = list_of(reference("cell"), "what is run, one after the other");
  cells["minItems"] = 1;
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "A study of gyrostat"}};
  schema.update(object(
      {{"$schema", text("this schema, for editors")},
       {"title", text("what the study is about")},
       {"seed", number(study_ranges::seed, 1, "of all noise")},
       {"cells", cells},
       {"failure_budget", number(study_ranges::share, 1, "share of all trials that may fail")}},
      "Monte Carlo robustness study of gyro compensation filters", {"cells"}));
  schema["definitions"] = definitions();
  return schema;
}

}  // namespace gyrostat
