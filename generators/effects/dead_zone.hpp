#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Rates about zero are not sensed (IEEE Std 528, dead band): up to the half width the rate is 0.
/// Beyond it is the rate itself, as behind a threshold, or the rate less the half width, as behind
/// a mechanical play, or between. What moves the element besides, as a dither does, rounds the
/// corners: sensed is the mean over its normal distribution. Drivers do the same to what the sensor
/// says, bias and noise included. The zone may end elsewhere below zero.
struct DeadZone {
  double half_width_dps = 0.5;
  double lost_beyond = 0.0;
  double of_output = 0.0;
  double dither = 0.0;
  double below_dps = 0.0;
  double of_element = 0.0;

  static constexpr std::string_view title = "small rates are not sensed";
  static constexpr Stage stage = Stage::conversion;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = DeadZone;
    return std::array{
        Field{"half_width_dps", &P::half_width_dps, "dps", ranges::non_negative,
              "largest rate that is not sensed"},
        Field{"lost_beyond", &P::lost_beyond, "1", ranges::fraction,
              "share of the half width that larger rates lose"},
        Field{"of_output", &P::of_output, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: what is written is 0 where it would be small; 0: the rate is not sensed"},
        Field{"dither", &P::dither, "1", ranges::fraction,
              "standard deviation of what moves the element besides, over the half width"},
        Field{"below_dps", &P::below_dps, "dps", ranges::non_negative,
              "half width below zero; 0: as above"},
        Field{"of_element", &P::of_element, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: of the rate before a filter; 0: behind it"},
    };
  }

  static constexpr DeadZone absent() { return {.half_width_dps = 0.0}; }

  Response response() const {
    if (of_output > 0.5) return Response::none;
    return of_element > 0.5 ? Response::of_element : Response::of_electronics;
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double rate = of_output < 0.5 ? series.rate_ref_dps[i] : series.gyro_dps[i];
      series.gyro_dps[i] -= lost(rate);
    }
  }

  /// On a rate's side of zero.
  double half_width_at(double rate_dps) const {
    return rate_dps < 0.0 && below_dps > 0.0 ? below_dps : half_width_dps;
  }

 private:
  double lost(double rate_dps) const {
    const double spread = dither * half_width_dps;
    const double above = half_width_dps, under = half_width_at(-1.0);
    constexpr double never = 9.0;  // standard deviations
    if (rate_dps - above > never * spread) return lost_beyond * above;
    if (-rate_dps - under > never * spread) return -lost_beyond * under;
    if (above - rate_dps >= never * spread && under + rate_dps >= never * spread) return rate_dps;
    const auto below = [](double z) {
      return std::abs(z) >= never ? (z > 0.0 ? 1.0 : 0.0)
                                  : 0.5 * std::erfc(-z / std::numbers::sqrt2);
    };
    const auto density = [](double z) {
      return std::abs(z) >= never ? 0.0
                                  : std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    };
    const double low = (-under - rate_dps) / spread, high = (above - rate_dps) / spread;
    const double below_low = below(low), below_high = below(high);
    return rate_dps * (below_high - below_low) + spread * (density(low) - density(high)) +
           lost_beyond * (above * (1.0 - below_high) - under * below_low);
  }
};

}  // namespace gyrostat::effects
