#pragma once

#include <array>
#include <span>
#include <vector>

#include <gyrostat/analysis/spectra/welch.hpp>
#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/gap/octaves.hpp>

namespace gyrostat::gap {

/// What the lenses look at: a recording, or a simulated replica of it, reduced once. A series
/// without its gyro or its heading leaves that half empty; of a part that is not asked for there
/// are no spectra and octaves.
struct Scene {
  Scene(const Conditions& conditions, const Series& series, std::span<const Part> of = both_parts);

  std::vector<double> rate_error_dps;  ///< gyro minus reference rate and drift, short gaps bridged
  std::span<const double> recorded_dps;   ///< as recorded; the series outlives its scene
  std::vector<double> slow_dps;           ///< its cluster means
  Eigen::VectorXd drift;                  ///< what was taken out, Conditions::drift_of()
  std::vector<double> heading_error_deg;  ///< without its mean; NaN where the compass is not valid
  std::vector<double> slow_heading_deg;   ///< its cluster means
  std::array<Spectrum, 2> spectra;        ///< of the rate error, a part each
  std::array<Spectrum, 2> slow_spectra;   ///< of slow_dps
  /// Of the rate error in samples, of slow_dps and slow_heading_deg in clusters; a part each.
  std::array<std::vector<Octave>, 2> octaves, slow_octaves, heading_octaves;

 private:
  void reduce_rate(const Conditions& conditions, const Series& series);
};

}  // namespace gyrostat::gap
