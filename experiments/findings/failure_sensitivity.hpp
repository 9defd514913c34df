#pragma once

#include <filesystem>
#include <vector>

#include <gyrostat/experiments/findings/sensitivity.hpp>

namespace gyrostat {

/// What a design says of how likely methods fail, whose cell asks for a failure: sensitivities of
/// the logarithm of the probability to the base of 10. The replicates of a point are the
/// independent runs of its search, or as many parts of its plain trials where those tell it. A
/// point whose failure is only known to be rarer than something has none, and counts as failed.
/// Nothing where no design asks for one.
std::vector<Sensitivity> failure_sensitivities(const Study& study, const Store& plain,
                                               const std::filesystem::path& folder);

}  // namespace gyrostat
