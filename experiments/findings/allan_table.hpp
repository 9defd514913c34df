#pragma once

#include <gyrostat/analysis/spectra/allan_coefficients.hpp>
#include <gyrostat/core/table.hpp>

namespace gyrostat {

/// Q, N, B, K and R with their 95 % intervals, in the units that engineers quote and in SI: a row
/// each. A coefficient that the recording does not show is blank and has an upper limit alone.
Table allan_coefficients_table(const AllanCoefficients& coefficients, const std::string& title);

}  // namespace gyrostat
