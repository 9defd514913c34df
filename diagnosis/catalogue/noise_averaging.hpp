#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/noise_averaging.hpp>

namespace gyrostat::gap {

/// Noise that is averaged once or twice, each a start of its own.
template <>
struct Diagnosed<effects::NoiseAveraging> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseAveraging::length};
  static constexpr std::string_view part = "output filter";
  static constexpr std::array alike = {&effects::NoiseAveraging::length};

  static std::vector<effects::NoiseAveraging> guesses(const Beside& /*beside*/) {
    return {{1.2, 1.0}, {2.2, 1.0}, {4.2, 1.0}, {0.8, 2.0}, {1.6, 2.0}, {3.2, 2.0}};
  }

  /// How often is; and what of two means shorter than a sample is left is a filter's as well, which
  /// need not be two that are alike.
  static std::size_t chosen_parameters(const effects::NoiseAveraging& effect) {
    return effect.stages > 1.5 && effect.length < 1.0 ? 2 : 1;
  }

  static void enter(const effects::NoiseAveraging& effect, NoiseLaw& law) {
    law.averaging = effect.autocovariance();
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::NoiseAveraging& effect, const Conditions& /*c*/) {
    return effect.autocovariance().size() > 1;
  }
};

}  // namespace gyrostat::gap
