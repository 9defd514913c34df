#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

namespace gyrostat::gap {

/// One that comes and goes (`vibration_bursts`), of a sensor at rest: the clearest beside a set and
/// away from its lines, where its odds are `clear`. It is a bin whose powers, block after block,
/// are a mixture of two exponentials, and those of the bins on either side hardly are.
std::optional<HiddenLine> hidden_bursts(const SetBench& bench, const Scenario& set,
                                        const std::vector<double>& left_dps, double clear);

}  // namespace gyrostat::gap
