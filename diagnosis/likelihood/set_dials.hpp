#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/dials.hpp>

namespace gyrostat::gap {

/// What a fit of a set moves: the white noise, the walk, the memory beside it where it has one, and
/// of each effect with a law or a slow signature its free parameters but the amplitudes, which are
/// found by least squares.
std::vector<Dial> dials_of(const Scenario& scenario);

}  // namespace gyrostat::gap
