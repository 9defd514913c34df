#pragma once

#include <optional>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/remainder/replicated.hpp>

namespace gyrostat::gap {

/// A slow error by its own covariance: by how much more cluster means of the recording differ than
/// those of replicas, lag by lag, as those of a Gauss-Markov process would. None where that is
/// nothing beside how replicas differ: its variance has to be clear of theirs by ten nats and by
/// twice the farthest of them, since a walk's are skewed.
std::optional<Nameless> rate_wander_part(const Conditions& conditions,
                                         const Replicated& replicated);
std::optional<Nameless> compass_wander_part(const Conditions& conditions,
                                            const Replicated& replicated);

}  // namespace gyrostat::gap
