#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/generators/effects/time_offset.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// What a recording's heading differs by from that of the reference, with effects on the compass.
class CompassErrors {
 public:
  CompassErrors(const Conditions& conditions, const Series& recording);

  struct Law {
    double count;          ///< effective number of values
    double variance;       ///< of the white noise
    double level_gain;     ///< of the level that walks beside it (WalkingLevel)
    double log_known = 0;  ///< of a value, on average

    double std_deg() const { return std::sqrt(variance); }
    /// Log-likelihood beyond another law's.
    double gain_on(const Law& other) const {
      return 0.5 * count * (std::log(other.variance / variance) + log_known - other.log_known);
    }
  };

  /// The heading less the reference's and what the effects add, NaN where it is not known.
  std::vector<double> of(const std::vector<Effect>& effects) const;
  /// Means of the clusters of which half as many samples are there as usually, at least; of a few,
  /// noise would pass for a burst.
  std::vector<double> means_of(const std::vector<Effect>& effects) const;
  /// Of white noise about a level that walks where that is clearly likelier, as it does where the
  /// rates of the reference do not add up to its heading; clusters that are `hidden` (a flag each)
  /// do not count.
  Law law_of(const std::vector<Effect>& effects, const std::vector<char>& hidden) const {
    return law_of_errors(of(effects), hidden);
  }
  Law law_of_errors(const std::vector<double>& errors, const std::vector<char>& hidden) const;
  double centre_deg() const { return centre_deg_; }
  /// The compass has the clock of a gyro that is late by a `time_offset`.
  void take_clock(const Effect& time_offset);
  /// What the heading is late by is left to the effects.
  void unshift() { shift_ = std::min(shift_, 0.0); }
  /// Errors are taken beside the shift of time that is left beside the effects: iron turns with the
  /// heading, and a shift shows as it does.
  void shift_beside(const std::vector<Effect>& effects, const std::vector<char>& hidden);
  /// Whether a sample is in a cluster that is; in none where no flags are given.
  bool is_hidden(const std::vector<char>& hidden, std::size_t sample) const;

 private:
  /// By how many samples the heading is late.
  double shift_of(const std::vector<double>& error, const std::vector<char>& hidden,
                  double level_gain) const;

  const Conditions& conditions_;
  const Series& recording_;
  /// What a heading comes from.
  Series turning_;
  std::optional<effects::TimeOffset> clock_;
  double centre_deg_ = 0.0, shift_ = 0.0;
};

}  // namespace gyrostat::gap
