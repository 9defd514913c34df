#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/scale_asymmetry.hpp>

namespace gyrostat::gap {

/// A share of the size of the rate, in both directions or in one.
template <>
struct Diagnosed<effects::ScaleAsymmetry> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::ScaleAsymmetry::error};
  static constexpr bool comes_in_forms = true;

  static std::vector<effects::ScaleAsymmetry> starts(const Evidence& e) {
    std::vector<effects::ScaleAsymmetry> all;
    for (const double one_side : {0.0, 1.0, -1.0})
      all.push_back(scaled(e, Trace::rate, effects::ScaleAsymmetry{.one_side = one_side},
                           [](auto& p, double a) { p.error = a; }));
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::ScaleAsymmetry& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
