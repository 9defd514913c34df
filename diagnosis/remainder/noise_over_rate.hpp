#pragma once

#include <optional>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/remainder/replicated.hpp>

namespace gyrostat::gap {

/// By how much the recording's steps from sample to sample are larger than those of replicas, rate
/// by rate, as a linear spline. Where that is the same at all rates, beyond what replicas differ
/// by, there is none: the spectrum says it.
std::optional<Nameless> noise_over_rate_part(const Conditions& conditions,
                                             const Replicated& replicated);

}  // namespace gyrostat::gap
