#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <gyrostat/core/table.hpp>
#include <gyrostat/diagnosis/compare/comparison.hpp>

namespace gyrostat::gap {

/// A comparison for people: the answer in a sentence or two, then what it rests on.
std::string in_words(const Comparison& comparison, const std::string& recordings,
                     const std::string& simulated);
std::vector<Table> comparison_tables(const Comparison& comparison);
/// For programs: the keys of a diagnosis where they mean the same, and "simulator".
nlohmann::ordered_json to_json(const Comparison& comparison);

}  // namespace gyrostat::gap
