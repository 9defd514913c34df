#pragma once

#include <string>

namespace gyrostat {

/// A colour for a share of [0, 1], dark blue to yellow; equally spaced for every eye.
std::string ramp(double share);

/// White for a ratio of 1, yellow to red for larger, on a logarithmic scale that ends at 10.
std::string ratio_colour(double ratio);

/// What a custom property of the page's style is in light: "#0072b2" for "m0".
std::string light_colour(const std::string& property);

/// Whether text on the colour "#rrggbb" is to be white.
bool is_dark(const std::string& colour);

}  // namespace gyrostat
