#pragma once

#include <string>
#include <vector>

#include <gyrostat/diagnosis/diagnosis.hpp>

namespace gyrostat::gap {

/// One of several that were diagnosed alike: an axis of a sensor, a sensor of a fleet, or what was
/// looked at of a long recording.
struct FleetMember {
  std::string name;
  Diagnosis diagnosis;
  std::size_t mean_of = 1;  ///< samples that a value of it is the mean of
};

/// A parameter of an effect over the members that have it, each with its own error and beside that
/// with a spread between them (random effects: Paule and Mandel, Journal of Research of the NBS 87,
/// 1982).
struct SharedParameter {
  std::string name, unit;
  double mean, mean_low, mean_high;        ///< 95 % (Hartung and Knapp, Statistics in Medicine 20,
                                           ///< 2001); NaN where no error is known
  double spread, spread_low, spread_high;  ///< standard deviation between members, 95 % (Q profile:
                                           ///< Viechtbauer, Statistics in Medicine 26, 2007); of
                                           ///< the values themselves where no error is known
  double p_equal;  ///< that chance alone makes equal members differ so (Cochran's Q)
};

/// An effect that two members have in the same form, or more. What has another form has other
/// parameters under the same names: they are told apart, not averaged.
struct SharedEffect {
  std::string effect;
  std::string form;  ///< its parameters that are whole numbers, "stages 2"; empty where it has none
  std::vector<std::string> members;
  std::vector<SharedParameter> parameters;  ///< of the first of its kind in each
  /// What of them all axes have alike was fitted once for these (diagnose_axes()): the spread is
  /// then 0 and has no interval, and p is of what each axis alone was found to have.
  bool fitted_once = false;
};

/// Those of most members first. Means share nothing: at another rate effects are others.
std::vector<SharedEffect> shared_effects(const std::vector<FleetMember>& members);

/// What all have, what some have, what one alone has; a sentence each. Means are left out.
std::string shared_in_words(const std::vector<FleetMember>& members);

}  // namespace gyrostat::gap
