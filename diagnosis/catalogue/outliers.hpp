#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/outliers.hpp>

namespace gyrostat::gap {

/// Innovations of two widths (`tails`).
template <>
struct Diagnosed<effects::Outliers> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::Outliers::probability,
                                                 &effects::Outliers::std_dps};

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Outliers& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
