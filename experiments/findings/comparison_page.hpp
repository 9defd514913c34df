#pragma once

#include <string>

namespace gyrostat::gap {

struct Comparison;

/// Where a simulator of the user's differs from recordings: the answer, then what it rests on, to
/// each lens, as one HTML page that needs nothing else.
std::string comparison_page(const Comparison& comparison, const std::string& recordings,
                            const std::string& simulated);

}  // namespace gyrostat::gap
