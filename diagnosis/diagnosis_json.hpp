#pragma once

#include <nlohmann/json_fwd.hpp>

#include <gyrostat/diagnosis/diagnosis.hpp>

namespace gyrostat::gap {

using Json = nlohmann::ordered_json;

/// The diagnosis as the gap contract has it.
Json to_json(const Diagnosis& diagnosis);
/// A study of one cell whose scenario has the effects that were added, ready for `gyrostat run`.
/// Its title says how much nearer that comes to the recording, which has the name.
Json scenario_json(const Diagnosis& diagnosis, const std::string& name);
/// Whether its effects and drift act on what the recording had beside its gyro: temperature, rates,
/// acceleration.
bool depends_on_conditions(const Diagnosis& diagnosis);
/// A list of the readings that depart, with their place and unit.
Json departures_json(const std::vector<Where>& departures);
/// The parameters of an effect, by name.
Json parameters_json(const Effect& effect);

}  // namespace gyrostat::gap
