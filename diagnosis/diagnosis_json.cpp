#include <gyrostat/diagnosis/diagnosis_json.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/parameter_map.hpp>

namespace gyrostat::gap {

Json parameters_json(const Effect& effect) {
  Json json = Json::object();
  for (std::size_t i = 0; i < effect.fields().size(); ++i)
    json[std::string(effect.fields()[i].name)] = effect.value(i);
  return json;
}

Json departures_json(const std::vector<Where>& departures) {
  Json list = Json::array();
  for (const auto& w : departures)
    list.push_back({{"lens", w.lens},
                    {"channel", w.channel},
                    {"coordinate", w.coordinate},
                    {"from", w.from},
                    {"to", w.to},
                    {"observed", w.observed},
                    {"simulated", w.simulated},
                    {"unit", w.unit},
                    {"p_adjusted", w.p_adjusted}});
  return list;
}

namespace {

/// JSON has no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// With what has no name, where there is such.
const Scenario& best_of(const Diagnosis& d) {
  return d.remainder.parts.empty() ? d.enriched : d.remainder.scenario;
}

/// The scenario with the effects, as a study has it.
Json study_json(const Diagnosis& d, const Scenario& scenario) {
  Json s;
  s["duration_s"] = d.duration_s;
  s["rate_hz"] = d.rate_hz;
  const auto put = [](Json& into, const auto& p) {
    for (const auto& field : p.fields()) into[std::string(field.name)] = p.*(field.member);
  };
  put(s["random_error"], scenario.random_error);
  put(s["thermal_drift"], scenario.thermal_drift);
  put(s["compass"], scenario.compass);
  s["effects"] = Json::array();
  for (const auto& any : scenario.effects) {
    Json effect = {{"effect", any.id()}};
    effect.update(parameters_json(any));
    s["effects"].push_back(effect);
  }
  return s;
}

}  // namespace

Json to_json(const Diagnosis& d) {
  Json json;
  json["recording"] = {{"samples", d.samples},
                       {"duration_s", d.duration_s},
                       {"rate_hz", d.rate_hz},
                       {"channels", d.channels}};
  Json parameters = Json::object();
  for (const auto& [name, value] : parameter_values(d.baseline.random_error))
    parameters[name] = value;
  for (const auto& [name, value] : parameter_values(d.baseline.thermal_drift))
    parameters[name] = value;
  parameters["compass_noise_std_deg"] = d.baseline.compass.noise_std_deg;
  json["baseline"] = {
      {"effects", Json::array({"white_noise", "arima111", "thermal_drift", "compass_noise"})},
      {"parameters", parameters}};
  json["where"] = departures_json(d.where);
  json["where_after"] = departures_json(d.where_after);
  json["gap"] = {{"before", d.gap_before},
                 {"after", d.gap_after},
                 {"closed", d.closed},
                 {"closed_interval", Json::array({d.closed_low, d.closed_high})},
                 {"p_before", d.p_before},
                 {"p_after", d.p_after},
                 {"p_held_out", d.p_held_out},
                 {"other_part_held_out", d.other_part_held_out},
                 {"log_score_gained", d.log_score_gained ? Json(*d.log_score_gained) : Json()}};
  json["causes"] = Json::array();
  for (const auto& c : d.causes)
    json["causes"].push_back({{"effect", c.effect},
                              {"probability", number(c.probability)},
                              {"gap_after", c.gap_after},
                              {"closed", c.closed},
                              {"log_score", c.log_score},
                              {"recovered", c.recovered},
                              {"parameters", parameters_json(c.scenario.effects.back())}});
  json["effects"] = Json::array();
  for (const auto& e : d.effects) {
    Json found = {{"effect", e.effect}, {"inclusion", e.inclusion}, {"log_odds", e.log_odds}};
    found["parameters"] = parameters_json(e.parameters.front());
    for (std::size_t k = 1; k < e.parameters.size(); ++k)
      found["further"].push_back(parameters_json(e.parameters[k]));
    found["intervals"] = Json::object();
    for (std::size_t f = 0; f < e.intervals.size(); ++f)
      if (std::isfinite(e.intervals[f][0]))
        found["intervals"][std::string(e.parameters.front().fields()[f].name)] =
            Json::array({e.intervals[f][0], e.intervals[f][1]});
    found["gap_without"] = e.gap_without;
    if (e.given) {
      found["of_all_axes"] = true;
      found["p_equal"] = std::isfinite(e.p_equal) ? Json(e.p_equal) : Json();
    }
    json["effects"].push_back(found);
  }
  json["line_sources"] = Json::array();
  for (const auto& line : d.line_sources)
    json["line_sources"].push_back({{"effect", line.effect},
                                    {"frequency_hz", line.frequency_hz},
                                    {"source", name_of(line.source)},
                                    {"channel", line.channel},
                                    {"coherence", line.coherence},
                                    {"p", line.p_value}});
  json["remainder"] = {{"gap", d.gap_after}, {"where", departures_json(d.where_after)}};
  json["remainder"]["closed_with"] = d.remainder.parts.empty() ? d.closed : d.remainder.closed;
  json["remainder"]["open"] = departures_json(d.remainder.where);
  json["remainder"]["with"] = Json::array();
  for (const auto& part : d.remainder.parts)
    json["remainder"]["with"].push_back({{"effect", part.effect.id()},
                                         {"in_words", part.in_words},
                                         {"parameters", parameters_json(part.effect)}});
  json["remainder"]["unexplained"] = Json::array();
  for (const auto& u : d.unexplained)
    json["remainder"]["unexplained"].push_back({{"what", u.what}, {"p", u.p_value}});
  if (const auto& once = d.transient)
    json["remainder"]["transient"] = {{"from_s", once->from_s},
                                      {"to_s", once->to_s},
                                      {"frequency_hz", once->frequency_hz},
                                      {"rms_dps", once->rms_dps},
                                      {"p", once->p_value}};
  json["verdict"] = d.verdict.text();
  json["verdict_set"] = Json::array();
  for (const auto& verdict : d.verdict_set) json["verdict_set"].push_back(verdict.text());
  json["steps"] = Json::array();
  for (const auto& e : d.enrichments) json["steps"].push_back({{"added", e.added}, {"gap", e.gap}});
  json["not_assessable"] = Json::array();
  for (const auto& n : d.not_assessable)
    json["not_assessable"].push_back({{"effect", n.effect}, {"why", n.why}});
  json["detectable"] = Json::array();
  for (const auto& seen : d.detectable) {
    const auto& field = seen.effect.fields()[seen.field];
    json["detectable"].push_back({{"effect", seen.effect.id()},
                                  {"parameter", field.name},
                                  {"size", seen.effect.value(seen.field)},
                                  {"unit", field.unit},
                                  {"power", Detectable::power},
                                  {"parameters", parameters_json(seen.effect)}});
  }
  json["transfer"] = Json::array();
  for (const auto& t : d.transfer)
    json["transfer"].push_back({{"filter", t.filter},
                                {"metric", t.metric},
                                {"unit", t.unit},
                                {"real", number(t.real)},
                                {"sim_before", number(t.before)},
                                {"sim_after", number(t.after)},
                                {"moved", name_of(t.moved)}});
  json["next_experiment"] = {{"what", d.next.what},
                             {"separates", Json::array({d.next.first, d.next.second})},
                             {"expected_power", d.next.expected_power}};
  json["enriched"] = study_json(d, d.enriched);
  return json;
}

bool depends_on_conditions(const Diagnosis& d) {
  const auto has = [&](std::string_view channel) {
    return std::find(d.channels.begin(), d.channels.end(), channel) != d.channels.end();
  };
  if (has("rate_ref_dps")) return true;
  const auto& scenario = best_of(d);
  const auto& drift = scenario.thermal_drift;
  if (has("temperature_C") && (drift.a_dps_per_C != 0.0 || drift.b_dps_s_per_C != 0.0)) return true;
  const auto acts_on = [](const Effect& effect, const auto channel) {
    const auto& needs = effect.type().needs;
    return std::find(needs.begin(), needs.end(), channel) != needs.end();
  };
  return std::any_of(scenario.effects.begin(), scenario.effects.end(), [&](const auto& effect) {
    return std::any_of(channels.begin(), channels.end(), [&](const auto& channel) {
      return channel.values != &Series::gyro_dps && channel.values != &Series::heading_deg &&
             has(channel.name) && acts_on(effect, channel.values);
    });
  });
}

Json scenario_json(const Diagnosis& d, const std::string& name) {
  const bool completed = !d.remainder.parts.empty();
  const auto& best = best_of(d);
  const auto title =
      completed ? fmt::format(
                      "{}: a simulator that comes {:.0f} % closer to it, {:.0f} % by effects that "
                      "have a name",
                      name, 100.0 * d.remainder.closed, 100.0 * std::max(0.0, d.closed))
      : d.enriched.effects.empty()
          ? fmt::format("{}: the simulator as it stands", name)
          : fmt::format("{}: a simulator that comes {:.0f} % closer to it (95 %: {:.0f} to {:.0f})",
                        name, 100.0 * d.closed, 100.0 * d.closed_low, 100.0 * d.closed_high);
  return {
      {"title", title},
      {"cells",
       Json::array({{{"name", "enriched"}, {"trials", 1000}, {"scenario", study_json(d, best)}}})}};
}

}  // namespace gyrostat::gap
