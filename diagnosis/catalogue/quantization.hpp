#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/quantization.hpp>

namespace gyrostat::gap {

/// The step is that of the values themselves; a fit to readings could only blur it.
template <>
struct Diagnosed<effects::Quantization> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array<double effects::Quantization::*, 0> free_parameters = {};

  static void enter(const effects::Quantization& effect, NoiseLaw& law) {
    law.rounding += effect.lsb_dps * effect.lsb_dps / 12.0;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Quantization& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
