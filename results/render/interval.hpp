#pragma once

#include <string>

namespace gyrostat {

/// "0.310 ± 0.042": the half width to two digits, the value to as many places.
std::string with_half_width(double value, double half_width);
/// The same where both ends lie about as far from the value, otherwise "0.31 (0.11 to 0.83)".
std::string with_interval(double value, double low, double high);

}  // namespace gyrostat
