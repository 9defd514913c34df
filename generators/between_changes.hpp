#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrostat {

/// Each of the strengths (0 or more, noisy) as the mean of the stretch that it is in, from change
/// to change. Changes are those that make the means of the logarithms over `block` strengths
/// likeliest, with so much taken off for each that noise has none (Jackson et al., IEEE Signal
/// Proc. Letters 12, 2005); then each goes to the likeliest sample.
std::vector<double> between_changes(std::span<const double> strength, std::size_t block);

}  // namespace gyrostat
