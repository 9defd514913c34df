#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/line_track.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

/// The band that a line fills.
Resonance band_of_line(const Effect& line);
bool are_neighbours(const Resonance& one, const Resonance& other);

/// A line that no spectrum shows clearly, but its track through the blocks does.
struct HiddenLine {
  Effect effect;
  double log_odds;
};

/// Beside a set and away from its lines: one that wanders, and vibration that comes and goes; those
/// whose odds are `clear`.
std::vector<HiddenLine> hidden_lines(const SetBench& bench, const Scenario& set,
                                     const std::vector<double>& left_dps, double clear);

}  // namespace gyrostat::gap
