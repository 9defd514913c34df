#pragma once

#include <vector>

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// What a remainder is estimated from: a recording and replicas of the simulator that is to become
/// like it, looked at in the same way, on the train part. Replicas carry all that is named, all
/// that the sampling does and all that a reduction does, so that no law of them is needed.
struct Replicated {
  struct Look {
    std::vector<double> error_dps;    ///< of the rate, a sample each; all of them
    std::vector<double> fast_dps;     ///< sizes of what FastPart leaves of the rate error, rising
    std::vector<double> log_density;  ///< ln(dps²/Hz), of the rate error, from 0 to half the rate
    std::vector<double> slow_dps;     ///< cluster means of the rate error; all of them
    std::vector<double> heading_deg;  ///< its error, a sample each; all of them
  };

  Replicated(const Simulator& simulator, const Series& recording, const Scenario& scenario);

  static constexpr std::size_t replicas_made = 12;

  Look recording;
  std::vector<Look> replicas;
};

/// Of a number that was read off the recording and off each replica: how far the recording lies
/// from their mean, and the variance of that where it is one of them.
struct Against {
  double off, variance;

  Against(double observed, const std::vector<double>& replicated);
  double chi_squared() const { return off * off / variance; }
};

}  // namespace gyrostat::gap
