#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/slow_noise.hpp>
#include <gyrostat/generators/effects/bias_instability.hpp>

namespace gyrostat::gap {

/// The flat part of the Allan variance.
template <>
struct Diagnosed<effects::BiasInstability> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::BiasInstability::coefficient_dps};

  static std::vector<Start> starts(const Evidence& e) {
    return slow_noise(e, SlowComponent::flicker,
                      [](const auto& fit) { return effects::BiasInstability{fit.slow_std_dps}; });
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::time(c); }

  static bool is_what_it_is_called(const effects::BiasInstability& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
