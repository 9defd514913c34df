#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>

namespace gyrostat::gap {

/// The diagnosis in one paragraph.
std::string in_words(const Diagnosis& diagnosis, const std::string& name);
/// Where, causes, steps, transfer and what cannot be assessed.
std::vector<Table> diagnosis_tables(const Diagnosis& diagnosis, const std::string& name);

}  // namespace gyrostat::gap
