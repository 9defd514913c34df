#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>

namespace gyrostat::gap {

/// The rate through a low-pass filter of one or two poles, each a start of its own.
template <>
struct Diagnosed<effects::SensorBandwidth> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SensorBandwidth::cutoff_hz};

  static std::vector<effects::SensorBandwidth> starts(const Evidence& e) {
    const double rate_hz = e.conditions().rate_hz();
    std::vector<effects::SensorBandwidth> all;
    for (const auto& form : {effects::SensorBandwidth{},
                             effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0}})
      all.push_back(shaped(e, Trace::rate, form, &effects::SensorBandwidth::cutoff_hz,
                           0.002 * rate_hz, 0.49 * rate_hz));
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::SensorBandwidth& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
