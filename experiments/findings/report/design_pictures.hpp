#pragma once

#include <vector>

#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/experiments/findings/report/method_colours.hpp>
#include <gyrostat/experiments/findings/report/sweep.hpp>
#include <gyrostat/experiments/findings/sensitivity.hpp>

namespace gyrostat {

/// Of one design, its methods as one picture each of: elasticities (tornado), elementary effects
/// (Morris plane), Sobol' indices; those that the design allows.
std::vector<Picture> sensitivity_pictures(const std::vector<Sensitivity>& of_design,
                                          const MethodColours& colours, const std::string& id);

/// The judging metric over one parameter as lines; over two as a map for each method and one of
/// winners, further parameters at their first value. None where too few of the combinations were
/// run.
std::vector<Picture> sweep_pictures(const Study& study, const Sweep& sweep,
                                    const std::vector<CellSummary>& summaries,
                                    const MethodColours& colours, const std::string& id);

}  // namespace gyrostat
