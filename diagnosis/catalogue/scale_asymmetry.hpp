#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/scale_asymmetry.hpp>

namespace gyrostat::gap {

/// A share of the size of the rate, of both directions or of one alone, each a start of its own.
template <>
struct Diagnosed<effects::ScaleAsymmetry> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::ScaleAsymmetry::error};

  static std::size_t chosen_parameters(const effects::ScaleAsymmetry& effect) {
    return effect.one_side == 0.0 ? 0 : 1;
  }

  static std::vector<effects::ScaleAsymmetry> starts(const Evidence& e) {
    std::vector<effects::ScaleAsymmetry> all;
    for (const double side : {0.0, 1.0, -1.0})
      all.push_back(scaled(e, Trace::rate, effects::ScaleAsymmetry{.one_side = side},
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
