#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/analysis/spectra/allan_coefficients.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat {

/// Q, N, B, K and R with their 95 % intervals, in the units that engineers quote and in SI: a row
/// each. A coefficient that the recording does not show is blank and has an upper limit alone.
Table allan_coefficients_table(const AllanCoefficients& coefficients, const std::string& title);

/// A recording's overlapping Allan deviation, and what it amounts to.
struct AllanFindings {
  std::vector<AllanPoint> points;
  std::optional<AllanCoefficients> coefficients;  ///< from 128 samples on
};

/// Of a rate in dps. Throws InputError at `name` for fewer than four samples.
AllanFindings allan_findings(std::span<const double> rate_dps, double rate_hz,
                             const std::string& name);

/// The points with their 95 % intervals, a row a tau, and the coefficients.
std::vector<Table> allan_tables(const AllanFindings& findings, const std::string& name);

/// Points, band and what the coefficients amount to, as engineers plot it: dps over s.
Picture allan_picture(const AllanFindings& findings, const std::string& title);

}  // namespace gyrostat
