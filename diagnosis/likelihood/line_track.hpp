#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/generators/effects/wandering_line.hpp>

namespace gyrostat::gap {

/// A line of constant amplitude that is followed from block to block, each long enough to show it
/// and short enough that it hardly moves. Log-likelihoods over those of normal noise.
struct LineTrack {
  double over_band = 0.0;   ///< of the same spectrum; 0: no better
  double over_noise = 0.0;  ///< without the line
  effects::WanderingLine line{};
};

/// In the place of `band`, beside `noise`. Where the blocks hold many periods a line shows that is
/// far below the noise, and that its spectrum alone does not tell from noise in a band.
LineTrack track_in_band(const Conditions& conditions, const std::vector<double>& left_dps,
                        const NoiseLaw& noise, const Resonance& band);

/// The clearest line below `highest_hz`, as the band that it wanders through; none where none is
/// likelier than the noise by `least`.
std::optional<Resonance> band_of_hidden_line(const Conditions& conditions,
                                             const std::vector<double>& left_dps,
                                             const NoiseLaw& noise, double least,
                                             double highest_hz);

}  // namespace gyrostat::gap
