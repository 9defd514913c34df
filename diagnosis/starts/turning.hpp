#pragma once

#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// How many samples are nearest to a quarter of a second, in whose means shaking is no turning.
std::size_t quarter_second(const Series& recording);

/// Means of a rate over so many samples, one after the other; missing where a sample is.
std::vector<double> quarter_second_means(const Series& recording,
                                         const std::vector<double>& rate_dps);

/// Largest less smallest of those that are there, without the hundredth at either end: a knock is
/// no turning either. 0 of none.
double inner_extent(const std::vector<double>& values);

}  // namespace gyrostat::gap
