#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/stale_samples.hpp>

namespace gyrostat::gap {

/// Values that repeat the one before, and those that repeat two.
template <>
struct Diagnosed<effects::StaleSamples> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::StaleSamples::probability,
                                                 &effects::StaleSamples::mean_run};

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::StaleSamples& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
