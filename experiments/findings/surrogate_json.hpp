#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/findings/sensitivity.hpp>

namespace gyrostat {

/// The surrogates among `sensitivities`, as JSON that needs nothing else to be computed: with each
/// parameter its coordinate u, and with each term its degrees and coefficient. "surrogates" is
/// empty where there are none.
std::string surrogate_json(const std::vector<Sensitivity>& sensitivities, const Study& study);

}  // namespace gyrostat
