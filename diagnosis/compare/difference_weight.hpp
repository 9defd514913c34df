#pragma once

#include <optional>
#include <string_view>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/compare/studied_side.hpp>

namespace gyrostat::gap {

/// Evidence for one form each, and how many parameters it is about.
struct Weight {
  double log_odds = 0.0, parameters = 1.0;
  /// Where one side alone has it: that this side has it at all.
  std::optional<double> there = {};
};

/// Log-likelihood that each side loses by the other's form of an effect, which may be none.
struct Losses {
  double real = 0.0, simulated = 0.0;
};

/// The common form costs least where it lies between both.
Weight by_losses(const Losses& losses, double parameters);

/// Whether traces have a law whose likelihood knows what another form of the effect costs.
bool has_loss(const CauseType& cause);
Losses losses_of(const CauseType& cause, const StudiedSide& real, const StudiedSide& simulated);

/// That an effect that both sides have differs: by its losses, by the errors of its parameters
/// where it has none, and beyond doubt where it is read off the values.
Weight weight_of(const CauseType& cause, const StudiedSide& real, const StudiedSide& simulated);

}  // namespace gyrostat::gap
