#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/beyond_secant.hpp>
#include <gyrostat/generators/butterworth.hpp>
#include <gyrostat/generators/continuous_low_pass.hpp>
#include <gyrostat/generators/forward_and_back.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The sensor follows the rate through a low-pass filter at its bandwidth (IEEE Std 1554,
/// bandwidth): equal poles, a rate being held over the interval before its sample, or
/// Butterworth's, by recursion as simulators do; either as a sensor does, to which the rate goes on
/// between its samples, or two poles of any damping; or the mean over the time before a sample, the
/// rate being straight between samples, or of whole samples, which takes 3 dB where the product of
/// time and frequency is 0.443 (Oppenheim and Schafer, "Discrete-Time Signal Processing", 3rd
/// ed., 2.6). Before the first sample it has come to rest, at that sample's rate or, where it went
/// on turning, at another. Poles of a recursion may be gone through forward and back, as whoever
/// filters a recording afterwards does: the rate is not late then (Gustafsson, IEEE Trans. Signal
/// Processing 44, 1996).
struct SensorBandwidth {
  double cutoff_hz = 5.0;
  double poles = 1.0;
  double maximally_flat = 0.0;
  double averages = 0.0;
  double continuous = 0.0;
  double damping_ratio = 0.0;
  double before_dps = 0.0;
  double zero_phase = 0.0;

  static constexpr int most_poles = 8;
  /// Cutoff times averaging time: sin(pi x) / (pi x) = 1 / sqrt(2).
  static constexpr double half_power_of_mean = 0.44294647;

  static constexpr std::string_view title = "the rate is low-passed";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = SensorBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which each pole, or all of Butterworth's, has taken 3 dB"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = most_poles, .whole = true},
              "how many poles"},
        Field{"maximally_flat", &P::maximally_flat, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: Butterworth's poles; 0: equal ones"},
        Field{"averages", &P::averages, "1", Range{.from = 0, .to = 2, .whole = true},
              "a moving average instead of poles, 1: over time; 2: of whole samples"},
        Field{"continuous", &P::continuous, "1", Range{.from = 0, .to = 2, .whole = true},
              "1: rate and filter go on between samples; 2: the rate straight; 0: a recursion over "
              "samples"},
        Field{"damping_ratio", &P::damping_ratio, "1", ranges::non_negative,
              "of a system of second order, going on between samples, whose natural frequency is "
              "the cutoff; 0: of the poles that are said"},
        Field{"before_dps", &P::before_dps, "dps", ranges::any,
              "rate before the first sample, less that at it"},
        Field{"zero_phase", &P::zero_phase, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: poles of a recursion forward and back, or a mean of samples about its own"},
    };
  }

  static constexpr SensorBandwidth absent() { return {.cutoff_hz = 1e9}; }

  Response response() const { return Response::of_electronics; }

  void apply(Series& series, const Noise& /*noise*/) const {
    const std::size_t samples = samples_with(series, needs);
    const auto& rate = series.rate_ref_dps;
    // Where the rate was missing it begins anew.
    for (std::size_t first = 0, last = 0; first < samples; first = last + 1) {
      for (last = first; last < samples && !std::isnan(rate[last]);) ++last;
      if (last < samples) series.gyro_dps[last] = rate[last];
      if (last > first + 1) follow(series, first, last);
    }
  }

 private:
  void follow(Series& series, std::size_t first, std::size_t last) const {
    const double begun_dps = series.rate_ref_dps[first] + (first == 0 ? before_dps : 0.0);
    const auto count =
        static_cast<std::size_t>(std::clamp(std::lround(poles), 1L, long{most_poles}));
    const auto& rate = series.rate_ref_dps;
    const double cycles = cutoff_hz * (series.t_s[last - 1] - series.t_s[first]) /
                          static_cast<double>(last - 1 - first);
    if (averages > 1.5) return average_samples(series, first, last, begun_dps, cycles);
    if (averages > 0.5) return average(series, first, last, begun_dps);
    if (damping_ratio > 0.0)
      return run_on(series, first, last, begun_dps,
                    LowPassSystem::of_second_order(cycles, damping_ratio));
    if (continuous > 0.5)
      return run_on(series, first, last, begun_dps,
                    LowPassSystem(cycles, count, maximally_flat > 0.5));
    if (zero_phase > 0.5) return follow_both_ways(series, first, last, cycles, count);
    if (maximally_flat > 0.5) {
      Butterworth sensed(cycles, count);
      for (std::size_t i = first; i < last; ++i)
        series.gyro_dps[i] += begun_dps + sensed(rate[i] - begun_dps) - rate[i];
      return;
    }
    Decay decay(0.5 / (std::numbers::pi * cutoff_hz));
    std::array<double, most_poles> sensed;
    sensed.fill(begun_dps);
    for (std::size_t i = first; i < last; ++i) {
      const double left = i == first ? 1.0 : decay(series.t_s, i);
      double passed = rate[i];
      for (std::size_t k = 0; k < count; ++k)
        passed = sensed[k] = passed + left * (sensed[k] - passed);
      series.gyro_dps[i] += passed - rate[i];
    }
  }

  void follow_both_ways(Series& series, std::size_t first, std::size_t last, double cycles,
                        std::size_t count) const {
    const auto& rate = series.rate_ref_dps;
    const auto sensed =
        forward_and_back({rate.data() + first, last - first}, 3 * (count + 1),
                         [&](std::vector<double>& values) { pass(values, cycles, count); });
    for (std::size_t i = first; i < last; ++i) series.gyro_dps[i] += sensed[i - first] - rate[i];
  }

  /// From rest at the first value.
  void pass(std::vector<double>& values, double cycles, std::size_t count) const {
    const double begun = values.front();
    if (maximally_flat > 0.5) {
      Butterworth sensed(cycles, count);
      for (double& value : values) value = begun + sensed(value - begun);
      return;
    }
    const double left = std::exp(-2.0 * std::numbers::pi * cycles);
    std::array<double, most_poles> sensed;
    sensed.fill(begun);
    for (double& value : values)
      for (std::size_t k = 0; k < count; ++k)
        value = sensed[k] = value + left * (sensed[k] - value);
  }

  /// Between samples straight, or a cubic with the slopes of TimeOffset.
  void run_on(Series& series, std::size_t first, std::size_t last, double begun_dps,
              const LowPassSystem& filter) const {
    ContinuousLowPass sensed(filter);
    const auto& rate = series.rate_ref_dps;
    const auto slope = [&](std::size_t i, double rise) {
      if (continuous > 1.5) return rise;
      return 0.5 * (rate[std::min(i + 1, last - 1)] - rate[std::max(i, first + 1) - 1]) +
             beyond_secant(rate, i, first, last);
    };
    series.gyro_dps[first] += begun_dps - rate[first];
    for (std::size_t i = first + 1; i < last; ++i) {
      const double rise = rate[i] - rate[i - 1];
      series.gyro_dps[i] +=
          begun_dps - rate[i] +
          sensed(rate[i - 1] - begun_dps, rate[i] - begun_dps, slope(i - 1, rise), slope(i, rise));
    }
  }

  /// The mean of each sample and those before it, or as many on either side; past the last there is
  /// its rate.
  void average_samples(Series& series, std::size_t first, std::size_t last, double begun_dps,
                       double cycles) const {
    const auto& rate = series.rate_ref_dps;
    const auto longest = static_cast<double>(last - first);
    const double wanted = std::clamp(half_power_of_mean / cycles, 1.0, longest);
    const long ahead = zero_phase > 0.5 ? std::lround(0.5 * (wanted - 1.0)) : 0;
    const long length = zero_phase > 0.5 ? 2 * ahead + 1 : std::lround(wanted);
    const auto from = static_cast<long>(first), to = static_cast<long>(last);
    const auto at = [&](long i) {
      return i < from ? begun_dps : rate[static_cast<std::size_t>(std::min(i, to - 1))];
    };
    double sum = 0.0;
    for (long i = from + ahead - length; i < from + ahead; ++i) sum += at(i);
    for (long i = from; i < to; ++i) {
      sum += at(i + ahead) - at(i + ahead - length);
      const auto k = static_cast<std::size_t>(i);
      series.gyro_dps[k] += sum / static_cast<double>(length) - rate[k];
    }
  }

  void average(Series& series, std::size_t first, std::size_t last, double begun_dps) const {
    const double over_s = half_power_of_mean / cutoff_hz;
    const auto& t_s = series.t_s;
    const auto& rate = series.rate_ref_dps;
    std::vector<double> turned(last, 0.0);  // since the first sample, degrees
    for (std::size_t i = first + 1; i < last; ++i)
      turned[i] = turned[i - 1] + 0.5 * (rate[i - 1] + rate[i]) * (t_s[i] - t_s[i - 1]);
    std::size_t at = first;  // the last sample that is not after the beginning of the mean
    for (std::size_t i = first; i < last; ++i) {
      const double begin_s = t_s[i] - over_s;
      while (at + 1 < i && t_s[at + 1] <= begin_s) ++at;
      const double into_s = begin_s - t_s[at];
      double before = into_s * (into_s < 0.0 ? begun_dps : rate[at]);
      if (into_s > 0.0 && at + 1 < last)
        before += 0.5 * into_s * into_s * (rate[at + 1] - rate[at]) / (t_s[at + 1] - t_s[at]);
      series.gyro_dps[i] += (turned[i] - turned[at] - before) / over_s - rate[i];
    }
  }
};

}  // namespace gyrostat::effects
