#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/angle_quantization.hpp>

namespace gyrostat::gap {

/// Samples that differ from their neighbours more than white noise does.
template <>
struct Diagnosed<effects::AngleQuantization> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::AngleQuantization::coefficient_deg};
  static constexpr std::string_view part = "angle register";
  static constexpr std::array alike = {&effects::AngleQuantization::coefficient_deg};

  static std::vector<effects::AngleQuantization> guesses(const Beside& beside) {
    const auto& noise = beside.fit.scenario.random_error;
    return {{0.5 * noise.measurement_noise_std_dps * beside.conditions.interval_s()}};
  }

  static void enter(const effects::AngleQuantization& effect, NoiseLaw& law) {
    const double std_dps = effect.coefficient_deg / law.interval_s;
    law.angle += 2.0 * std_dps * std_dps;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::AngleQuantization& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
