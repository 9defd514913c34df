#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// White noise about a level, and a value of the grid that it was rounded to.
struct RestingNoise {
  double level_dps, std_dps, offset_dps;
};

/// What was rounded to a grid of `lsb_dps` where the train part rests on two or three of its
/// values, its level staying: the likeliest, by how many samples have each value (probit; Finney,
/// "Probit Analysis", 1947). Of two values the noise is known from above alone; it is then as large
/// as they allow. None where there is no grid, or the level moves.
std::optional<RestingNoise> resting_noise(const Conditions& conditions,
                                          const std::vector<double>& gyro_dps, double lsb_dps);

}  // namespace gyrostat::gap
