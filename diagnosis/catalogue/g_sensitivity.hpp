#pragma once

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/likelihood/felt_acceleration.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/g_sensitivity.hpp>

namespace gyrostat::gap {

/// The rate follows the acceleration along three axes.
template <>
struct Diagnosed<effects::GSensitivity> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::GSensitivity::x_dps_per_mps2,
                                                 &effects::GSensitivity::y_dps_per_mps2,
                                                 &effects::GSensitivity::z_dps_per_mps2};

  static constexpr std::size_t amplitudes = 3;
  /// Of all axes, or of one.
  static std::vector<effects::GSensitivity> guesses(const Beside& /*beside*/) {
    return {{1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  }

  /// What one axis does not say, another effect that goes with the acceleration would.
  static std::vector<effects::GSensitivity> told_otherwise(const effects::GSensitivity& effect,
                                                           const Conditions& /*c*/) {
    if (chosen_parameters(effect) == 0) return {};
    const double hardly =
        1e-9 * std::max({std::abs(effect.x_dps_per_mps2), std::abs(effect.y_dps_per_mps2),
                         std::abs(effect.z_dps_per_mps2)});
    const auto at_least_hardly = [&](double value) { return value == 0.0 ? hardly : value; };
    return {{at_least_hardly(effect.x_dps_per_mps2), at_least_hardly(effect.y_dps_per_mps2),
             at_least_hardly(effect.z_dps_per_mps2)}};
  }

  static std::size_t chosen_parameters(const effects::GSensitivity& effect) {
    const bool of_all = effect.x_dps_per_mps2 != 0.0 && effect.y_dps_per_mps2 != 0.0;
    return of_all ? 0 : 1;
  }

  static std::string why_not_assessable(const Conditions& c) {
    constexpr double least_change_mps2 = 0.5;
    if (!c.has_acceleration()) return "there are no acc_x_mps2, … columns";
    const double span = std::max(
        {extent(c.slow_means(c.series().acc_x_mps2)),
         c.series().acc_y_mps2.empty() ? 0.0 : extent(c.slow_means(c.series().acc_y_mps2)),
         c.series().acc_z_mps2.empty() ? 0.0 : extent(c.slow_means(c.series().acc_z_mps2))});
    if (span >= least_change_mps2 || is_shaken(c)) return {};
    return fmt::format("the acceleration changes by {:.2g} m/s²; at least {:g} m/s² are needed",
                       span, least_change_mps2);
  }

  static bool is_what_it_is_called(const effects::GSensitivity& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
