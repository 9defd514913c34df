#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <gyrostat/core/random.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

/// One sensor of a fleet: the scenario that its diagnosis found, and what that knows of it.
struct FleetUnit {
  std::string name;
  Scenario scenario;
  /// Standard errors of the fields of each effect, NaN where they are not known.
  std::vector<std::vector<double>> errors;
};

/// "stages 2": an effect's parameters that are whole numbers choose between laws, so that its
/// others mean something else.
std::string form_of(const Effect& effect);

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

/// The population that diagnosed units of one kind are from, and its next unit: random error and
/// thermal drift by their FleetLaws; the effects of one of the units, each as likely, their
/// parameters by the laws of those units that have the effect in that form. What a unit alone has
/// keeps that unit's values. Parameters beyond their range are drawn again, all of the unit's.
///
/// Example: sensor 17 of the fleet that three diagnosed scenarios are from.
///
///   const auto sensor_17 = [](const Scenario& a, const Scenario& b, const Scenario& c) {
///     const Fleet fleet({{"a", a, {}}, {"b", b, {}}, {"c", c, {}}}, "fleet");
///     Scenario sensor;
///     fleet.draw(fleet.nominal(), {.seed = 1, .trial = 17}, sensor);
///     return sensor;
///   };
///
/// Thread safety: a fleet is only read once it is there, by any number of threads at once.
class Fleet {
 public:
  /// Of two units or more of one sampling rate; InputError at `place` otherwise.
  Fleet(std::vector<FleetUnit> units, const std::string& place);

  /// The mean unit: every parameter at its law's mean, and the effects that more than half of the
  /// units have. Sampling is the units', all else that of a default scenario.
  const Scenario& nominal() const { return nominal_; }
  const std::vector<FleetUnit>& units() const { return units_; }
  const std::vector<FleetLaw>& laws() const { return laws_; }  ///< of random error and drift

  /// The parameters called `stated`, or "effects", are the study's and not drawn. `nominal` is the
  /// scenario with these values, whose delta2 follows a stated delta1. Throws InputError at `place`
  /// where more than half of the draws would lie beyond a range.
  void settle(const std::set<std::string>& stated, Scenario& nominal, const std::string& place);
  bool draws_effects() const { return !stated_.contains("effects"); }
  /// Share of draws that are made again.
  double redrawn() const { return redrawn_; }

  /// `nominal` with what is drawn: the same unit for the same address of `noise`, whatever else is
  /// drawn there. Throws std::runtime_error after 1000 attempts.
  void draw(const Scenario& nominal, const Noise& noise, Scenario& drawn) const;

 private:
  struct EffectLaws {
    std::vector<FleetLaw> fields;
  };
  class Deviates;

  bool is_drawn(const FleetLaw& law) const { return !stated_.contains(law.name); }
  /// Whether all that is drawn lies in range; else `beyond` is a parameter that does not.
  bool try_draw(const Scenario& nominal, std::size_t unit, const Deviates& deviates,
                Scenario& drawn, const FleetLaw** beyond) const;

  std::vector<FleetUnit> units_;
  std::vector<FleetLaw> laws_;
  std::vector<std::vector<EffectLaws>> effect_laws_;  ///< by unit and effect
  bool by_ratio_ = true;  ///< delta2 is drawn by theta = delta2 / delta1
  std::set<std::string> stated_;
  Scenario nominal_;
  double redrawn_ = 0.0;
};

/// The parameters of a sensor on one line: "phi 0.5, ..., vibration".
std::string sensor_in_words(const Scenario& sensor);

}  // namespace gyrostat
