#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/generators/effects/vibration_bursts.hpp>

namespace gyrostat::gap {

/// A line that comes and goes and that no spectrum of the whole shows.
struct HiddenBursts {
  effects::VibrationBursts bursts;
  double log_odds;
};

/// Of a sensor at rest the clearest beside a set and away from its lines, where its odds are
/// `clear`: a bin whose powers, block after block, are a mixture of two exponentials, and those of
/// the bins on either side hardly are.
std::optional<HiddenBursts> hidden_bursts(const SetBench& bench, const Scenario& set,
                                          const std::vector<double>& left_dps, double clear);

}  // namespace gyrostat::gap
