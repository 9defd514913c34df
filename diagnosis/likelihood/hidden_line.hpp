#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/line_track.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

/// The band that a line fills.
Resonance band_of_line(const Effect& line);
bool are_neighbours(const Resonance& one, const Resonance& other);

/// A line that no spectrum of the whole shows clearly.
struct HiddenLine {
  Effect line;
  double log_odds;
};

/// One that wanders, which its track through the blocks shows: the clearest beside a set and away
/// from its lines, where its odds are `clear`.
std::optional<HiddenLine> hidden_line(const SetBench& bench, const Scenario& set,
                                      const std::vector<double>& left_dps, double clear);

}  // namespace gyrostat::gap
