#pragma once

#include <span>
#include <string>
#include <vector>

#include <gyrostat/experiments/findings/ranking.hpp>

namespace gyrostat {

/// What a ranking says, in plain sentences, the most important first.
std::vector<std::string> ranking_sentences(const Cell& cell, const CellRanking& ranking);

/// The answer of many cells in two sentences: of one, the first two that its ranking says; of more,
/// how many cells each method wins. Empty where nothing was ranked.
std::string answer_in_words(std::span<const CellRanking> rankings);

}  // namespace gyrostat
