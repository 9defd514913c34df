#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/beyond_secant.hpp>
#include <gyrostat/generators/delayed_heading.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Gyro and reference have clocks of their own: the gyro shows the rate that the reference had
/// `offset` earlier, or later where it is negative, and clocks of unlike pace drift apart. Between
/// samples the rate is a cubic through both neighbours with the slopes of their neighbours (cubic
/// convolution, Keys, IEEE Trans. ASSP 29, 1981), where it is smooth with beyond_secant(), which is
/// within 0.2 % of a sine of up to an eighth of the sampling rate at any delay; or straight, as
/// tables are looked up; before the first and after the last sample it is theirs. A compass on the
/// gyro's board has its clock.
struct TimeOffset {
  double offset_s = 0.05;
  double drift_ppm = 0.0;
  double of_compass = 0.0;
  double straight = 0.0;

  static constexpr std::string_view title = "the clocks of gyro and reference differ";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = TimeOffset;
    return std::array{
        Field{"offset_s", &P::offset_s, "s", ranges::any,
              "how much later the gyro shows a rate than the reference"},
        Field{"drift_ppm", &P::drift_ppm, "1e-6", Range{.from = -1e5, .to = 1e5},
              "how much more of that each second since the first sample brings"},
        Field{"of_compass", &P::of_compass, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the compass has the gyro's clock; 0: the reference's"},
        Field{"straight", &P::straight, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the rate is straight between its samples; 0: a cubic"},
    };
  }

  static constexpr TimeOffset absent() { return {.offset_s = 0.0}; }

  Response response() const { return Response::of_electronics; }

  /// At sample i.
  double late_s(const std::vector<double>& t_s, std::size_t i) const {
    return offset_s + 1e-6 * drift_ppm * (t_s[i] - t_s[0]);
  }

  /// What the compass shows of the true heading, before anything that disturbs it.
  void show_heading(Series& series) const {
    if (of_compass > 0.5)
      delay_heading(
          series.t_s, [&](std::size_t i) { return late_s(series.t_s, i); }, series.heading_deg);
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    const std::size_t n = samples_with(series, needs);
    if ((offset_s == 0.0 && drift_ppm == 0.0) || n == 0) return;
    const auto& t_s = series.t_s;
    const auto& rate = series.rate_ref_dps;
    const auto slope = [&](std::size_t i) {
      const std::size_t from = i == 0 ? 0 : i - 1, to = std::min(i + 1, n - 1);
      const double over_s = t_s[to] - t_s[from];
      return (rate[to] - rate[from] + 2.0 * beyond_secant(rate, i, 0, n)) / over_s;
    };
    std::size_t at = 0;  // the last sample that is not after the time asked for
    std::size_t between = n;
    double slope_from = 0.0, slope_to = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double then_s = t_s[i] - late_s(t_s, i);
      while (at + 1 < n && t_s[at + 1] <= then_s) ++at;
      double seen = rate[at];
      if (then_s > t_s[at] && at + 1 < n) {
        const double interval_s = t_s[at + 1] - t_s[at], x = (then_s - t_s[at]) / interval_s;
        const double rise = rate[at + 1] - rate[at];
        seen += x * rise;
        if (straight < 0.5) {
          if (at != between) {
            slope_from = at == between + 1 ? slope_to : slope(at);
            slope_to = slope(at + 1);
            between = at;
          }
          const double from = slope_from * interval_s - rise, to = slope_to * interval_s - rise;
          seen += x * (1.0 - x) * ((1.0 - x) * from - x * to);
        }
      }
      series.gyro_dps[i] += seen - rate[i];
    }
  }
};

}  // namespace gyrostat::effects
