#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gyrostat/core/random.hpp>
#include <gyrostat/experiments/study/fleet_law.hpp>
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
  /// Which effect of a unit is the same as which of another: its name, form, and which of its kind;
  /// with the units that have it and its place in each.
  using EffectKey = std::tuple<std::string, std::string, int>;
  using Found = std::map<EffectKey, std::vector<std::pair<std::size_t, std::size_t>>>;
  class Deviates;

  static std::vector<EffectKey> keys_of(const Scenario& scenario);
  void require_one_rate(const std::string& place) const;
  void add_laws();
  void add_effect_laws(const Found& found);
  void make_nominal(const Found& found);

  bool is_drawn(const FleetLaw& law) const { return !stated_.contains(law.name); }
  /// Whether all that is drawn lies in range; else `beyond` is a parameter that does not.
  bool try_draw(const Scenario& nominal, std::size_t unit, const Deviates& deviates,
                Scenario& drawn, const FleetLaw** beyond) const;

  std::vector<FleetUnit> units_;
  std::vector<FleetLaw> laws_;
  std::vector<std::vector<std::vector<FleetLaw>>> effect_laws_;  ///< by unit, effect and field
  std::set<std::string> stated_;
  Scenario nominal_;
  double redrawn_ = 0.0;
};

/// The parameters of a sensor on one line: "phi 0.5, ..., vibration".
std::string sensor_in_words(const Scenario& sensor);

}  // namespace gyrostat
