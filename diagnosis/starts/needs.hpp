#pragma once

#include <string>
#include <vector>

namespace gyrostat::gap {

class Conditions;

/// What effects need of a recording: each says why the recording lacks it, with how much more it
/// would take, or nothing where it does not.
namespace needs {

/// Any recording shows the effect.
std::string nothing(const Conditions& conditions);
inline constexpr double least_warming_C = 1.0;

/// A temperature that changes by so much.
std::string warming(const Conditions& conditions);
/// Minutes, for 1/f noise: in less it cannot be told from the memory of the random error.
std::string time(const Conditions& conditions);
/// A reference rate that changes.
std::string motion(const Conditions& conditions);
std::string heading(const Conditions& conditions);
/// A heading, and turns through a quarter of a circle, of which one harmonic is told from another.
std::string turns(const Conditions& conditions);

}  // namespace needs

/// Largest less smallest value; 0 of none.
double extent(const std::vector<double>& values);

}  // namespace gyrostat::gap
