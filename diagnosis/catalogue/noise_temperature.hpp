#pragma once

#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/generators/effects/noise_temperature.hpp>

namespace gyrostat::gap {

/// The variance of the steps over temperature; the reference is the mean temperature, where the
/// noise is the white one.
template <>
struct Diagnosed<effects::NoiseTemperature> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseTemperature::relative_per_C};

  static std::vector<Start> starts(const Evidence& e) {
    const auto& T = e.conditions().series().temperature_C;
    double sum = 0.0, mean_T = 0.0, count = 0.0, tt = 0.0, tv = 0.0;
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& span : e.conditions().spans(Part::train))
        for (std::size_t i = span.first + 1; i < span.last; ++i) {
          const double v =
              0.5 * std::pow(e.scene.rate_error_dps[i] - e.scene.rate_error_dps[i - 1], 2);
          if (pass == 0) {
            sum += v;
            mean_T += T[i];
            count += 1.0;
          } else {
            const double d = T[i] - mean_T / count;
            tt += d * d;
            tv += d * (v - sum / count);
          }
        }
    return {
        {effects::NoiseTemperature{tt > 0.0 ? 0.5 * tv / tt / (sum / count) : 0.0, mean_T / count},
         with_white(e, std::sqrt(sum / count))}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::warming(c); }

  static bool is_what_it_is_called(const effects::NoiseTemperature& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
