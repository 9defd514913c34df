#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

/// Whether an effect gives the motion a response in time: a filter, a shift.
bool is_of_response(std::string_view effect);

/// What the rates of nine neighbouring samples still explain of what a set leaves, by least
/// squares: between samples a motion is not known, and filters have more forms than the catalogue.
/// It passes a constant rate as it is, and beside a shift alone one that grows evenly, so that it
/// stands in for no scale and no shift. None where the set has no effect that gives a response in
/// time, or all of it is too little to tell.
std::optional<Effect> response_left(const SetBench& bench, const Scenario& set);

/// Likewise beside a set that gives none: with a scale and a shift.
std::optional<Effect> whole_response(const SetBench& bench, const Scenario& set);

/// Samples whose rate, between those of the reference, is not known to two standard deviations of
/// the noise: a straight line misses a curve by an eighth of the second difference (de Boor, "A
/// Practical Guide to Splines", III). None where the set has no response in time, or where more
/// than a quarter would be.
std::vector<char> samples_of_unknown_rate(const Conditions& conditions, const Scenario& set,
                                          double noise_dps);

/// The first and the last, as many as a set shifts beyond the reference.
std::vector<char> samples_shifted_beyond(const Conditions& conditions, const Scenario& set);

}  // namespace gyrostat::gap
