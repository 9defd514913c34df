#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/compass_errors.hpp>
#include <gyrostat/diagnosis/likelihood/heading_bursts.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

bool is_lag(const Effect& effect);

/// Fits sets of effects on the compass to the train part of a recording's heading, of which
/// clusters within bursts do not count.
class CompassBench {
 public:
  CompassBench(const Simulator& simulator, const Series& recording, const Scenario& baseline);

  const Conditions& conditions() const { return conditions_; }
  CompassErrors::Law law_of(const std::vector<Effect>& effects) const;
  double centre_deg() const { return errors_.centre_deg(); }
  /// Where the compass clearly has the clock of a gyro that is late by `time_offset`, it does from
  /// then on, and `time_offset` says so; the law that it had by the reference's clock.
  std::optional<CompassErrors::Law> took_clock(Effect& time_offset);
  /// Of what a set leaves (heading_left.hpp).
  double log_gain_of_turning(const std::vector<Effect>& set) const;
  /// What an effect has to gain to be in a set, in nats.
  double cost(const Effect& effect) const;

  /// Of an effect, from what others leave.
  std::vector<Effect> starts(const CauseType& cause, const std::vector<Effect>& beside) const;
  std::vector<Effect> polished(std::vector<Effect> set) const;
  /// The set itself where that is no likelier.
  std::vector<Effect> in_other_form(std::vector<Effect> set, std::size_t at) const;
  /// With its lag through other poles or at another place, where that is likelier.
  std::vector<Effect> told_otherwise(const std::vector<Effect>& set) const;
  /// Where iron and a lag are both there, what iron adds trails, too, or does not.
  std::vector<Effect> in_likelier_form(std::vector<Effect> set) const;
  /// Log-likelihood of all means, bursts or not, less what the set costs.
  double robust_score(const std::vector<Effect>& set) const;

  const HeadingBursts& bursts() const { return bursts_; }
  void find_bursts(const std::vector<Effect>& effects);
  /// Every cluster counts.
  void forget_bursts();
  /// Errors are taken beside a shift of time where nothing in the set is one: CompassErrors.
  void shift_beside(const std::vector<Effect>& set);
  void unshift() { errors_.unshift(); }

 private:
  /// Clusters until what was turned before has died out of a compass that trails; 0 where none
  /// does.
  std::size_t trailing(const std::vector<Effect>& effects) const;
  std::vector<char> beside_turns(const std::vector<Effect>& effects) const;

  const Simulator& simulator_;
  const Conditions& conditions_;
  const Series& recording_;
  Scenario baseline_;
  CompassErrors errors_;
  double cost_of_a_value_;
  HeadingBursts bursts_;
};

}  // namespace gyrostat::gap
