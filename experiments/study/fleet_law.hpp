#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <gyrostat/core/fields.hpp>

namespace gyrostat {

/// What is known of a parameter of the next unit:
///   on its scale, x = mean + sqrt(spread^2 + mean_error^2) t,  t of Student's law,
/// the posterior prediction of random effects (Higgins, Thompson and Spiegelhalter, Journal of the
/// Royal Statistical Society A 172, 2009; with the mean's error after Hartung and Knapp). Without
/// errors of their own, n units with standard deviation s make it mean + s sqrt(1 + 1/n) t(n-1).
struct FleetLaw {
  std::string name, unit;
  Range allowed;
  bool logarithmic = false;  ///< its scale: where it can be positive alone and is so in all units
  double mean = 0.0;         ///< on its scale
  double scale = 0.0;        ///< sqrt(spread^2 + mean_error^2); 0: a constant, the mean
  double degrees = 0.0;      ///< of freedom: units that have it, less one
  /// By unit: its share of the differences, of unit length. Laws of one draw weigh the same
  /// deviates by it, so that parameters that go together in the units do so in the draw.
  std::vector<double> direction;

  double value_at(double on_scale) const;
  /// Within the allowed range, and where it is logarithmic within a factor of 1000 of the mean.
  bool takes(double value) const;
};

/// The law of `field` in a fleet of `units`, from its `values` in `members` of them and their
/// standard errors; where one of these is NaN, none is believed.
FleetLaw fleet_law(const FieldInfo& field, std::size_t units,
                   const std::vector<std::size_t>& members, const std::vector<double>& values,
                   const std::vector<double>& errors);

}  // namespace gyrostat
