#pragma once

#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {

/// Samples of `left_dps`, which a scenario leaves, within the bursts of its narrow bands: a flag a
/// sample.
std::vector<char> samples_in_bursts(const SetBench& bench, const Scenario& scenario,
                                    const std::vector<double>& left_dps);

/// Gives narrow bands of a found set, of which `standing` is what the likelihood fitted, the names
/// that their envelopes say (LineShape); what becomes a wandering line is fitted as one. Samples
/// that are `hidden` do not count.
void name_lines(const SetBench& bench, Standing standing, const std::vector<char>& hidden,
                FoundSet& found);

}  // namespace gyrostat::gap
