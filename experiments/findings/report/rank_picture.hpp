#pragma once

#include <string>

#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/findings/report/method_colours.hpp>

namespace gyrostat {

/// Mean ranks of a cell's methods. A bar joins those that differ by no more than the critical
/// difference (Demsar, JMLR 7, 2006, fig. 1); a grey line links those whose errors are not
/// separable.
Picture rank_picture(const CellRanking& ranking, const MethodColours& colours,
                     const std::string& id);

}  // namespace gyrostat
