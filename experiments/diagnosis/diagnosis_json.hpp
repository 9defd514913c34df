#pragma once

#include "experiments/diagnosis/diagnosis.hpp"
#include "experiments/json_object.hpp"

namespace gyrostat::gap {

/// The diagnosis as the gap contract has it.
Json to_json(const Diagnosis& diagnosis);
/// A study of one cell whose scenario has the effects that were added, ready for `gyrostat run`.
Json scenario_json(const Diagnosis& diagnosis);
/// The parameters of an effect, by name.
Json parameters_json(const Effects::Any& effect);

}  // namespace gyrostat::gap
