#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/compare/comparison.hpp>

namespace gyrostat::gap {

/// How an effect that both sides have differs between them; nothing where no value does by a
/// twentieth, which may be clear and matters to nobody.
std::optional<Differs> how_differs(const CauseType& cause, const std::vector<Effect>& real,
                                   const std::vector<Effect>& simulated);

/// What makes traces that have the simulated form of an effect have the real one. A slow curve is
/// linear in its amplitudes, so that the one is taken out and the other put in; nothing, of others,
/// where the traces have any.
std::vector<Effect> instead_of(const CauseType& cause, std::vector<Effect> real,
                               std::vector<Effect> simulated);

}  // namespace gyrostat::gap
