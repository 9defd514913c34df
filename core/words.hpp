#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gyrostat {

struct Range;

// How numbers stand in sentences, wherever one is said.

/// "1 cell", "3 cells".
std::string counted(std::uint64_t count, std::string_view noun);

/// A probability of chance, as a test tells it: "= 0.021", or "< 1e-6" where it is less. No test of
/// ours sees enough replicas, or knows a distribution's tail well enough, to say how much less.
std::string chance_in_words(double p);
inline constexpr double least_chance = 1e-6;

/// The values of a range: "[0, inf)", "[1, 1e8] trials, whole numbers". The unit "1" is none.
std::string values_in_words(const Range& range, std::string_view unit = "");

}  // namespace gyrostat
