#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>

namespace gyrostat::gap {

/// The rate through a low-pass filter.
template <>
struct Diagnosed<effects::SensorBandwidth> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SensorBandwidth::cutoff_hz};

  static std::vector<effects::SensorBandwidth> starts(const Evidence& e) {
    const double rate_hz = e.conditions().rate_hz();
    return {shaped(e, Trace::rate, effects::SensorBandwidth{}, &effects::SensorBandwidth::cutoff_hz,
                   0.002 * rate_hz, 0.5 * rate_hz)};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::SensorBandwidth& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
