#include <nlohmann/json.hpp>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

nlohmann::ordered_json ieee_coefficient(const AllanCoefficient& c, double factor, double value,
                                        const char* unit) {
  const double scale = radians * factor;
  return {{"value", value}, {"from", scale * c.lower}, {"to", scale * c.upper}, {"unit", unit}};
}

/// JSON in the terms of IEEE Std 952 annex C, in SI units, with every effect under its name here.
std::string write_ieee(const ModelSheet& sheet) {
  const auto& model = sheet.model;
  nlohmann::ordered_json json = {{"_comment", sheet.remarks}, {"rate_hz", model.rate_hz}};
  json["N"] = ieee_coefficient(model.N, 1.0, sheet.N, "rad/s/sqrt(Hz)");
  json["B"] = ieee_coefficient(model.B, 1.0, sheet.B, "rad/s");
  json["K"] = ieee_coefficient(model.K, 1.0, sheet.K, "rad/s*sqrt(Hz)");
  json["constant_bias"] = {{"value", radians * model.constant_bias_dps}, {"unit", "rad/s"}};
  json["effects"] = nlohmann::ordered_json::array();
  for (const auto& effect : model.scenario.effects) {
    nlohmann::ordered_json entry = {{"effect", effect.id()}};
    for (std::size_t i = 0; i < effect.fields().size(); ++i)
      entry[std::string(effect.fields()[i].name)] = effect.value(i);
    json["effects"].push_back(entry);
  }
  return json.dump(2) + '\n';
}

}  // namespace

ModelFormat model_format_ieee() {
  std::vector<std::string_view> all;
  for (const auto& type : effect_types()) all.push_back(type.id);
  return {.id = "ieee",
          .title = "JSON in IEEE 952 terms",
          .file = "gyro.json",
          .holds = std::move(all),
          .write = write_ieee};
}

}  // namespace gyrostat
