#pragma once

#include <optional>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/remainder/replicated.hpp>

namespace gyrostat::gap {

/// A compass noise whose tails are as heavy as the recording's: of which the steps have its
/// kurtosis. `set` says what noise it is besides; none where that has bursts, or where replicas'
/// steps have as heavy tails.
std::optional<Nameless> compass_tails_part(const Conditions& conditions,
                                           const Replicated& replicated, const Scenario& set);

}  // namespace gyrostat::gap
