#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// Standard errors of the fields of an effect that is read off single samples and not fitted by a
/// likelihood: outliers and repeats, of which there are so many, and noise over temperature. NaN
/// for what is not told so, and of any other effect.
///
/// Of n samples of the train part, k = n p hits tell their probability p to within p sqrt((1 - p) /
/// k) (binomial), a deviation s to s / sqrt(2 k), the mean m of geometric runs to sqrt(m (m - 1) /
/// k); the logarithm of the noise, log(1 + b (T - T0)), tells b to 1 / sqrt(2 sum (T - T0)^2).
std::vector<double> errors_by_count(const Effect& effect, const Conditions& conditions);

}  // namespace gyrostat::gap
