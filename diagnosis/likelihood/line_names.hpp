#pragma once

#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {

/// Gives narrow bands of a found set the names that their envelopes say (LineShape). Samples that
/// are `hidden` do not count.
void name_lines(const SetBench& bench, const std::vector<char>& hidden, FoundSet& found);

}  // namespace gyrostat::gap
