#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/line_track.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

/// The band that a line fills.
Resonance band_of_line(const Effect& line);
bool are_neighbours(const Resonance& one, const Resonance& other);

/// A line that wanders and that no spectrum shows clearly, but its track through the blocks does.
struct HiddenLine {
  effects::WanderingLine line;
  double log_odds;
};

/// The clearest beside a set and away from its lines, where its odds are `clear`.
std::optional<HiddenLine> hidden_line(const SetBench& bench, const Scenario& set,
                                      const std::vector<double>& left_dps, double clear);

}  // namespace gyrostat::gap
