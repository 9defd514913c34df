#pragma once

#include <vector>

#include <gyrostat/diagnosis/evidence.hpp>

namespace gyrostat::gap {

/// Half of a normal variable lies within so many standard deviations of its mean.
inline constexpr double normal_quartile = 0.6744897501960817;

/// The value below which `share` of `values` lie; 0 of none.
double quantile(std::vector<double> values, double share);

/// Steps of the rate error from sample to sample of the train part.
std::vector<double> train_steps(const Evidence& e);

}  // namespace gyrostat::gap
