#pragma once

#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/spectra/allan_coefficients.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat {

/// Q, N, B, K and R with their 95 % intervals, in the units that engineers quote and in SI: a row
/// each. A coefficient that the recording does not show is blank and has an upper limit alone.
Table allan_coefficients_table(const AllanCoefficients& coefficients, const std::string& title);

/// The overlapping Allan deviation of a rate in dps with its 95 % intervals, a row a tau, and from
/// 128 samples on its coefficients. Throws InputError at `name` for fewer than four samples.
std::vector<Table> allan_tables(std::span<const double> rate_dps, double rate_hz,
                                const std::string& name);

/// The first of these tables, as engineers plot it.
Picture allan_picture(const Table& deviations);

}  // namespace gyrostat
