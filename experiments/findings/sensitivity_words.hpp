#pragma once

#include <string>

#include <gyrostat/experiments/findings/sensitivity.hpp>

namespace gyrostat {

/// "kf: probability matters most to bias_rmse (total index 0.60, 0.23 to 1.1), then phi (...)".
/// Empty where the design has no sensitivities.
std::string sensitivity_sentence(const Sensitivity& sensitivity);

}  // namespace gyrostat
