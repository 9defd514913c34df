#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Whether the acceleration along an axis changes within clusters by half a m/s² (standard
/// deviation): any accelerometer's noise is left behind.
bool is_shaken(const Conditions& conditions);

/// Sizes by least squares with their standard errors.
struct SizesWithin {
  std::vector<double> sizes, errors;
};

/// Of `courses`, a value a sample each, in an `error`: of what is faster than means of clusters,
/// over the train part, the noise being white. None where one of them changes by less than half a
/// unit, as m/s².
std::optional<SizesWithin> sizes_within_clusters(const Conditions& conditions,
                                                 const std::vector<char>& masked,
                                                 const std::vector<double>& error,
                                                 const std::vector<std::vector<double>>& courses);

/// Leaves of what an acceleration adds to the rate, a value a sample, what is slower than means of
/// clusters, and of what is faster the share that the rate's `error` follows, by least squares over
/// the train part: the rest is the accelerometer's own noise. Samples that are `masked` do not
/// count.
void keep_what_shows(const Conditions& conditions, const std::vector<char>& masked,
                     const std::vector<double>& error, std::vector<double>& felt);

}  // namespace gyrostat::gap
