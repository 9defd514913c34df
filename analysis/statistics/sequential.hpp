#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gyrostat {

/// Trial counts at which a study looks at its results: first, 1.4 first, 2 first, 2.8 first, ...;
/// whole numbers, all below or equal to `last`.
std::vector<std::uint32_t> look_counts(std::uint32_t first, std::uint32_t last);

/// How many standard errors wide intervals must be at each of the looks so that all of them hold
/// together with probability above 1 - alpha, however many looks follow: a repeated confidence
/// interval (Jennison and Turnbull, JRSS B 51, 1989), whose error of alpha / (k (k + 1)) is spent
/// at look k (Lan and DeMets, Biometrika 70, 1983) and found by the recursion of Armitage,
/// McPherson and Rowe (JRSS A 132, 1969). One may stop at any look, for any reason. `counts`
/// increase.
std::vector<double> sequential_bounds(std::span<const std::uint32_t> counts, double alpha);

/// The one-sided tail of the normal distribution above `bound`.
double normal_tail(double bound);

}  // namespace gyrostat
