#pragma once

#include <optional>
#include <string>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// A sensor that turns without a reference that says how.
struct UnreferencedTurning {
  double extent_dps = 0.0;                    ///< of the axis that turns most
  double rest_from_s = 0.0, rest_to_s = 0.0;  ///< the longest rest; equal where there is none
};

/// Nothing where there is a rate_ref_dps or the sensor rests: turning is 5 dps and more on any of
/// the axes, of which 2 come and go within a second.
std::optional<UnreferencedTurning> turning_without_reference(const Series& recording);

/// What that means for a diagnosis, and which rest could be looked at alone.
std::string in_words(const UnreferencedTurning& turning);

}  // namespace gyrostat::gap
