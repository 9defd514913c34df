#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/rate_ramp.hpp>

namespace gyrostat::gap {

/// A line through the slow rate.
template <>
struct Diagnosed<effects::RateRamp> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::RateRamp::slope_dps_per_s};

  static std::vector<effects::RateRamp> guesses(const Beside& /*beside*/) { return {{1.0}}; }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::RateRamp& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
