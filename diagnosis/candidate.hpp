#pragma once

#include <limits>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// What estimates of an effect's parameters are made from.
struct Evidence {
  const Simulator& simulator;
  const Series& recording;
  Scene scene;
  Scenario baseline;     ///< fitted to the recording
  double white_std_dps;  ///< of the recording, from its single steps
  double seconds_of_train() const;
};

/// Random error and thermal drift of a recording: the baseline's, or what is left of them beside an
/// effect.
struct Rest {
  Arima111<double> random_error;
  ThermalDrift<double> thermal_drift;
};

/// An effect with first parameters, and what is left beside it.
struct Start {
  Effect effect;
  Rest rest;
  /// No more log score than this can be due to the effect: of a slow signature half its squared
  /// t-statistic, since a random walk imitates every slow curve.
  double most_gain = std::numeric_limits<double>::infinity();
};

/// Whether the parameters are what the effect's name says: narrow-band noise is narrower than its
/// frequency is high but no line, slow errors last for more than a few samples, a disturbance of
/// the compass does not turn it round.
bool is_what_it_is_called(const Effect& effect, const Conditions& conditions);

/// Why the recording cannot show the effect, with how much more it would need; empty where it can.
std::string why_not_assessable(const Effect& effect, const Conditions& conditions);

/// First parameters of the effect from the recording, one set or several; an effect without an
/// estimate of its own starts from its defaults.
std::vector<Start> starts(const Effect& effect, const Evidence& evidence);

/// Whether the effect is the same in every replica: then least squares on the recording finds its
/// parameters, and a fit to simulated readings moves the noise alone.
bool is_deterministic(const Effect& effect);
/// Names of the parameters that the recording decides; the others would move nothing that the
/// baseline does not.
std::vector<std::string_view> free_parameters(const Effect& effect);

}  // namespace gyrostat::gap
