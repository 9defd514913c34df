#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/between_changes.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Vibration shifts the bias (IEEE Std 528, acceleration-squared-sensitive drift
/// rate): + coefficient times the mean square of what the
/// specific force deviates by from its own mean, of all three axes together. Both means forget with
/// the time constant, or the force's own with another; so gravity, and turning it slowly, count for
/// nothing. Or the mean square is
/// centred: it looks ahead as far as back, for the bias does not wait for a mean. Or it is
/// that of the stretch between two changes of the vibration: what squares tell of its strength is
/// noisy, and the vibration of a machine keeps to a strength until it is set to another.
struct VibrationRectification {
  double coefficient_dps_per_m2ps4 = 0.01;
  double time_constant_s = 2.0;
  double between_its_changes = 0.0;
  double centred = 0.0;
  double mean_time_constant_s = 0.0;

  static constexpr std::string_view title = "the bias depends on the strength of vibration";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::acc_x_mps2, &Series::acc_y_mps2,
                                       &Series::acc_z_mps2};

  static constexpr auto fields() {
    using P = VibrationRectification;
    return std::array{
        Field{"coefficient_dps_per_m2ps4", &P::coefficient_dps_per_m2ps4, "dps/(m/s²)²",
              ranges::any, "bias per mean square of the vibration"},
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::positive,
              "time over which it is averaged"},
        Field{"between_its_changes", &P::between_its_changes, "1",
              Range{.from = 0, .to = 1, .whole = true},
              "1: the mean square is that of a stretch of even vibration"},
        Field{"centred", &P::centred, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the mean square looks ahead as far as back"},
        Field{"mean_time_constant_s", &P::mean_time_constant_s, "s", ranges::non_negative,
              "time over which the force's own mean is taken; 0: the same"},
    };
  }

  static constexpr std::array axes = {&Series::acc_x_mps2, &Series::acc_y_mps2,
                                      &Series::acc_z_mps2};

  static constexpr VibrationRectification absent() { return {.coefficient_dps_per_m2ps4 = 0.0}; }

  /// Mean square of the vibration at each sample, (m/s²)².
  std::vector<double> mean_square(const Series& series) const {
    std::vector<double> squares(samples_with(series, axes));
    auto mean = begun_mean(series);
    Decay decay(time_constant_s);
    Decay decay_of_mean(mean_time_constant_s > 0.0 ? mean_time_constant_s : time_constant_s);
    double averaged = 0.0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const double kept = decay(series.t_s, i), kept_of_mean = decay_of_mean(series.t_s, i);
      double square = 0.0;
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const double now = (series.*axes[k])[i];
        if (i > 0 || mean_time_constant_s == 0.0) mean[k] = now + kept_of_mean * (mean[k] - now);
        square += (now - mean[k]) * (now - mean[k]);
      }
      averaged = square + kept * (averaged - square);
      squares[i] = between_its_changes > 0.5 ? square : averaged;
    }
    if (centred > 0.5)
      for (std::size_t i = squares.size(); i-- > 1;) {
        const double kept = decay(series.t_s, i);
        squares[i - 1] += kept * (squares[i] - squares[i - 1]);
      }
    if (between_its_changes < 0.5 || squares.size() < 2) return squares;
    const double interval_s =
        (series.t_s[squares.size() - 1] - series.t_s[0]) / static_cast<double>(squares.size() - 1);
    const double block = std::max(0.5 / interval_s, static_cast<double>(squares.size()) / 4096.0);
    return between_changes(squares, static_cast<std::size_t>(std::max(block, 4.0)));
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    const auto squares = mean_square(series);
    for (std::size_t i = 0, n = std::min(samples_with(series, needs), squares.size()); i < n; ++i)
      series.gyro_dps[i] += coefficient_dps_per_m2ps4 * squares[i];
  }

 private:
  /// Of a time of its own, over the first of it: from the first value alone it would be wrong for
  /// long.
  std::array<double, axes.size()> begun_mean(const Series& series) const {
    std::array<double, axes.size()> mean{};
    const std::size_t n = samples_with(series, axes);
    if (mean_time_constant_s == 0.0 || n == 0) return mean;
    double count = 0.0;
    for (std::size_t i = 0; i < n && series.t_s[i] - series.t_s[0] < mean_time_constant_s; ++i) {
      count += 1.0;
      for (std::size_t k = 0; k < axes.size(); ++k)
        mean[k] += ((series.*axes[k])[i] - mean[k]) / count;
    }
    return mean;
  }
};

}  // namespace gyrostat::effects
