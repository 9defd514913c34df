#pragma once

#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/vibration_rectification.hpp>

namespace gyrostat::gap {

/// The slow rate follows the mean square of the vibration, at once, as it is averaged, behind or
/// about each sample, or from change to change: a start of its own each.
template <>
struct Diagnosed<effects::VibrationRectification> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {
      &effects::VibrationRectification::coefficient_dps_per_m2ps4};

  static std::size_t chosen_parameters(const effects::VibrationRectification& /*effect*/) {
    return 1;
  }
  static std::vector<effects::VibrationRectification> guesses(const Beside& beside) {
    const double least_s = 2.0 * beside.conditions.interval_s();
    std::vector<effects::VibrationRectification> all;
    for (const double averaged_s : {0.1, 0.5, 1.0, 2.0, 4.0, 8.0})
      all.push_back({1.0, std::max(averaged_s, least_s)});
    for (const double averaged_s : {0.1, 0.2, 0.5, 1.0})
      all.push_back({1.0, std::max(averaged_s, least_s), 0.0, 1.0});
    for (const double averaged_s : {0.1, 2.0})
      all.push_back({1.0, std::max(averaged_s, least_s), 1.0});
    // What manoeuvres do to the force lasts longer than the sensor averages.
    for (const double averaged_s : {0.0, 0.2, 0.5, 1.0, 2.0, 4.0})
      for (const double mean_s : {8.0, 100.0})
        all.push_back({1.0, std::max(averaged_s, least_s), 0.0, 0.0, mean_s});
    for (const double averaged_s : {0.2, 0.5, 1.0})
      all.push_back({1.0, std::max(averaged_s, least_s), 0.0, 1.0, 100.0});
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) {
    constexpr double least_change_m2ps4 = 0.01;
    const auto squares = effects::VibrationRectification{}.mean_square(c.series());
    if (squares.empty())
      return "there are no acc_x_mps2, acc_y_mps2 and acc_z_mps2 columns; add the accelerometer's "
             "that shares the sensor's housing";
    const double span = extent(c.slow_means(squares));
    if (span >= least_change_m2ps4) return {};
    return fmt::format(
        "the mean square of the vibration changes by {:.2g} (m/s²)²; at least {:g} (m/s²)² are "
        "needed: let it be shaken, and let it rest",
        span, least_change_m2ps4);
  }

  /// Datasheets have up to some thousandths; what would have to be a hundred times as much only
  /// goes as the accelerometer's noise does.
  static bool is_what_it_is_called(const effects::VibrationRectification& effect,
                                   const Conditions& /*c*/) {
    constexpr double most_dps_per_m2ps4 = 1.0;
    return std::abs(effect.coefficient_dps_per_m2ps4) <= most_dps_per_m2ps4;
  }
};

}  // namespace gyrostat::gap
