#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/experiments/cli/diagnosed.hpp>

namespace gyrostat::cli {

nlohmann::ordered_json members_json(const std::vector<gap::FleetMember>& members,
                                    const std::string& kind) {
  gap::Json json = {{"each", gap::Json::array()}, {"shared", gap::Json::array()}};
  for (const auto& m : members) {
    gap::Json one = {{kind, m.name}};
    if (m.mean_of > 1) one["mean_of"] = m.mean_of;
    one["diagnosis"] = gap::to_json(m.diagnosis);
    json[m.mean_of > 1 ? "means" : "each"].push_back(std::move(one));
  }
  const auto number = [](double value) { return value == value ? gap::Json(value) : gap::Json(); };
  for (const auto& s : gap::shared_effects(members)) {
    gap::Json one = {{"effect", s.effect},
                     {"form", s.form},
                     {"in", s.members},
                     {"fitted_once", s.fitted_once},
                     {"parameters", gap::Json::object()}};
    for (const auto& p : s.parameters)
      one["parameters"][p.name] = {
          {"unit", p.unit},
          {"mean", p.mean},
          {"mean_interval", gap::Json::array({number(p.mean_low), number(p.mean_high)})},
          {"spread", number(p.spread)},
          {"spread_interval", gap::Json::array({number(p.spread_low), number(p.spread_high)})},
          {"p_equal", number(p.p_equal)}};
    json["shared"].push_back(std::move(one));
  }
  return json;
}

}  // namespace gyrostat::cli
