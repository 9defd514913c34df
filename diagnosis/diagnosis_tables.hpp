#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>

namespace gyrostat::gap {

/// The answer in plain words, then the numbers that it rests on.
std::string in_words(const Diagnosis& diagnosis, const std::string& name);
/// Causes, steps, transfer, where the recording leaves the simulator (in the units that readings
/// are logarithms of) and what cannot be assessed.
std::vector<Table> diagnosis_tables(const Diagnosis& diagnosis, const std::string& name);

}  // namespace gyrostat::gap
