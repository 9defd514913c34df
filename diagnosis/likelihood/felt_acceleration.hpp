#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Leaves of what an acceleration adds to the rate, a value a sample, what is slower than means of
/// clusters, and of what is faster the share that the rate's `error` follows, by least squares over
/// the train part: the rest is the accelerometer's own noise. Samples that are `masked` do not
/// count.
void keep_what_shows(const Conditions& conditions, const std::vector<char>& masked,
                     const std::vector<double>& error, std::vector<double>& felt);

}  // namespace gyrostat::gap
