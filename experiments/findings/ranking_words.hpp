#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/findings/ranking.hpp>

namespace gyrostat {

/// What a ranking says, in plain sentences, the most important first.
std::vector<std::string> ranking_sentences(const Cell& cell, const CellRanking& ranking);

}  // namespace gyrostat
