#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/thermal_lag.hpp>

namespace gyrostat::gap {

/// The slow rate follows the temperature late, through one pole or two, each a start of its own,
/// from rest or not.
template <>
struct Diagnosed<effects::ThermalLag> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::ThermalLag::sensitivity_dps_per_C,
                                                 &effects::ThermalLag::start_dps,
                                                 &effects::ThermalLag::time_constant_s};
  static constexpr std::string_view part = "thermal path";
  static constexpr std::array alike = {&effects::ThermalLag::time_constant_s};
  static constexpr std::size_t amplitudes = 2;

  static std::vector<effects::ThermalLag> guesses(const Beside& beside) {
    std::vector<effects::ThermalLag> all;
    for (const double start : {0.0, 1.0})
      for (const double poles : {1.0, 2.0})
        for (const double memory_s : beside.memories_s())
          all.push_back({1.0, memory_s, poles, start});
    return all;
  }

  static std::size_t chosen_parameters(const effects::ThermalLag& effect) {
    // A start off the temperature is as much of a surprise as a start-up.
    return std::size_t{effect.poles > 1.0} + (effect.start_dps != 0.0 ? 2 : 0);
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::warming(c); }

  /// One that has not settled to 5 % is a ramp; one within the ten seconds over which T' is
  /// taken is what another recorder calls T'.
  static bool is_what_it_is_called(const effects::ThermalLag& effect, const Conditions& c) {
    constexpr double least_s = 10.0;
    return effect.time_constant_s > least_s &&
           3.0 * effect.time_constant_s < c.interval_s() * static_cast<double>(c.size());
  }
};

}  // namespace gyrostat::gap
