#pragma once

#include <optional>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/remainder/replicated.hpp>

namespace gyrostat::gap {

/// The map from the sizes of the fast errors of replicas to those of the recording, through their
/// quantiles; none where counts between the replicas' quantiles are what chance makes them (the
/// likelihood ratio of a multinomial, over what autocorrelation makes of it in replicas; Rao and
/// Scott, Annals of Statistics 12, 1984). Knots go as far out as a sample of the
/// recording lies beyond.
std::optional<Nameless> distribution_part(const Replicated& replicated);

}  // namespace gyrostat::gap
