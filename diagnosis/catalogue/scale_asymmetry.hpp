#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/scale_asymmetry.hpp>

namespace gyrostat::gap {

/// A share of the size of the rate. Beside a scale factor of the same size, one direction is right
/// (SetSearcher::join_to_one_side).
template <>
struct Diagnosed<effects::ScaleAsymmetry> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::ScaleAsymmetry::error};

  static std::vector<effects::ScaleAsymmetry> starts(const Evidence& e) {
    return {
        scaled(e, Trace::rate, effects::ScaleAsymmetry{}, [](auto& p, double a) { p.error = a; })};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::ScaleAsymmetry& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
