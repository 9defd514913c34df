#pragma once

#include <string>
#include <vector>

#include "experiments/ranking.hpp"

namespace gyrostat {

/// "0.310 ± 0.042": the half width to two digits, the value to as many places.
std::string with_half_width(double value, double half_width);

/// What a ranking says, in plain sentences, the most important first.
std::vector<std::string> ranking_sentences(const Cell& cell, const CellRanking& ranking);

}  // namespace gyrostat
