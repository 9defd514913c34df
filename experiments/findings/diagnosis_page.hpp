#pragma once

#include <string>

namespace gyrostat::gap {

struct Diagnosis;

/// The answer, then what it rests on, from the recording to each lens, as one HTML page that needs
/// nothing else.
std::string diagnosis_page(const Diagnosis& diagnosis, const std::string& name);

}  // namespace gyrostat::gap
