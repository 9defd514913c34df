#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/generators/effects/sinusoidal.hpp>

namespace gyrostat::gap {

/// A sine that stands out from the random line about it.
struct LineWithin {
  effects::Sinusoidal sine;
  /// By how much such a peak is rarer than one: minus the logarithm of its probability under noise
  /// whose density is that of the neighbours.
  double log_rarity;
};

/// The highest peak of the train part's periodogram in `band`, over the mean of its neighbours
/// within an eighth of the band to either side: of exponential powers a peak's over the mean of n
/// others is beyond r with probability (1 + r / n)^-n (an F distribution with 2 and 2 n degrees of
/// freedom). None where the band is as narrow as its periodogram can tell.
std::optional<LineWithin> line_within(const Conditions& conditions,
                                      const std::vector<double>& left_dps, const Resonance& band);

}  // namespace gyrostat::gap
