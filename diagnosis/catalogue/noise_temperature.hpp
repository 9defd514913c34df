#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/noise_temperature.hpp>

namespace gyrostat::gap {

/// The variance of the steps over temperature; the reference is the mean temperature, where the
/// noise is the white one.
template <>
struct Diagnosed<effects::NoiseTemperature> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseTemperature::relative_per_C};

  static std::string why_not_assessable(const Conditions& c) { return needs::warming(c); }

  static bool is_what_it_is_called(const effects::NoiseTemperature& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
