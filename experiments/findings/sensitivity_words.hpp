#pragma once

#include <string>

#include <gyrostat/experiments/findings/sensitivity.hpp>

namespace gyrostat {

/// "kf: probability matters most to bias_rmse (total index 0.60, 0.23 to 1.1), then phi (...)".
/// Empty where the design has no sensitivities.
std::string sensitivity_sentence(const Sensitivity& sensitivity);

/// "kf: a chaos of 23 terms leaves 0.4 % (up to 0.7 %) of the variance unexplained: trusted, ...",
/// or that it is not and what the indices are without it. Of a sensitivity with a surrogate.
std::string surrogate_verdict(const Sensitivity& sensitivity);

}  // namespace gyrostat
