#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/butterworth.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/sampled_low_pass.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// An output filter of unit gain at rest colours the white noise (IEEE Std 1554, bandwidth): equal
/// poles, each exact between samples, or Butterworth's of the same order by the bilinear transform
/// (Oppenheim and Schafer, "Discrete-Time Signal Processing", 3rd ed., 7.2), or so two poles of any
/// damping; or any of them in continuous time before noise is sampled, of which what is above half
/// the sampling rate is folded below it. The noise keeps its density well below the cutoff. What
/// comes after the filter, as a converter does, adds white noise of its own.
struct NoiseBandwidth {
  double cutoff_hz = 20.0;
  double poles = 1.0;
  double maximally_flat = 0.0;
  double continuous = 0.0;
  double after_dps = 0.0;
  double damping_ratio = 0.0;
  double zero_phase = 0.0;

  static constexpr std::string_view title = "an output filter colours the white noise";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = NoiseBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which each pole, or all of Butterworth's, has taken 3 dB"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = most_poles, .whole = true},
              "how many poles"},
        Field{"maximally_flat", &P::maximally_flat, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: Butterworth's poles; 0: equal ones"},
        Field{"continuous", &P::continuous, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: before sampling, of four poles at most; 0: a recursion over samples"},
        Field{"after_dps", &P::after_dps, "dps", ranges::non_negative,
              "standard deviation of the white noise after the filter"},
        Field{"damping_ratio", &P::damping_ratio, "1", ranges::non_negative,
              "of a system of second order whose natural frequency is the cutoff; 0: of the poles "
              "that are said"},
        Field{"zero_phase", &P::zero_phase, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: a recursion goes forward and back, so that its gain counts twice"},
    };
  }

  static constexpr int most_poles = 8;
  bool operator==(const NoiseBandwidth&) const = default;
  static constexpr NoiseBandwidth absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& noise) const {
    const std::size_t samples = samples_with(series, needs);
    if (samples < 2) return;
    pass(series, samples);
    // Noise has no past that would tell forward from back.
    if (zero_phase > 0.5 && !is_folded()) pass(series, samples);
    if (after_dps == 0.0) return;
    const auto after = noise.stream("noise_bandwidth/after");
    for (std::size_t i = 0; i < samples; ++i) series.gyro_dps[i] += after_dps * after.normal(i);
  }

  /// Multiplies by |H|² at angles (radians a sample), where a sampling interval is `interval_s`.
  void multiply_gain(std::span<const double> angles, std::span<const double> cosines,
                     double interval_s, std::span<double> gain) const {
    if (is_folded()) {
      const double cycles = cutoff_hz * interval_s;
      const auto folded = damping_ratio > 0.0
                              ? FoldedGain::of_second_order(cycles, damping_ratio)
                              : FoldedGain(cycles, sampled_poles(), maximally_flat > 0.5);
      for (std::size_t k = 0; k < gain.size(); ++k)
        gain[k] *= folded(0.5 * angles[k] / std::numbers::pi);
      return;
    }
    const auto there_and_back = [&](double once) { return zero_phase > 0.5 ? once * once : once; };
    if (damping_ratio > 0.0 || maximally_flat > 0.5) {
      if (cutoff_hz * interval_s >= 0.5) return;
      const double edge = std::tan(std::numbers::pi * cutoff_hz * interval_s);
      for (std::size_t k = 0; k < gain.size(); ++k) {
        // The square of the tangent of half the angle; beyond 1e12 nothing passes.
        const double bent = (1.0 - cosines[k]) / (std::max(1.0 + cosines[k], 1e-12) * edge * edge);
        gain[k] *= there_and_back(damping_ratio > 0.0 ? second_order_gain(bent, damping_ratio)
                                                      : 1.0 / (1.0 + to_the_poles(bent)));
      }
      return;
    }
    const double pole = std::exp(-2.0 * std::numbers::pi * cutoff_hz * interval_s);
    for (std::size_t k = 0; k < gain.size(); ++k) {
      const double of_one =
          (1.0 - pole) * (1.0 - pole) / (1.0 - 2.0 * pole * cosines[k] + pole * pole);
      gain[k] *= there_and_back(to_the_poles(of_one));
    }
  }

 private:
  std::size_t count() const {
    return static_cast<std::size_t>(std::clamp(std::lround(poles), 1L, long{most_poles}));
  }
  double to_the_poles(double x) const {
    double power = x;
    for (std::size_t k = 1; k < count(); ++k) power *= x;
    return power;
  }

  void pass(Series& series, std::size_t samples) const {
    const auto filter = [&](auto&& passed) {
      for (std::size_t i = 0; i < samples; ++i) {
        const double white = error_beside_drift(series, i);
        series.gyro_dps[i] += passed(i, white) - white;
      }
    };
    const double cycles = cutoff_hz * series.duration_s() / static_cast<double>(samples - 1);
    if (is_folded()) {
      SampledLowPass before_sampling(
          damping_ratio > 0.0 ? LowPassSystem::of_second_order(cycles, damping_ratio)
                              : LowPassSystem(cycles, sampled_poles(), maximally_flat > 0.5));
      filter([&](std::size_t /*i*/, double white) { return before_sampling(white); });
      return;
    }
    if (damping_ratio > 0.0 || maximally_flat > 0.5) {
      auto sections = damping_ratio > 0.0 ? Butterworth::damped(cycles, damping_ratio)
                                          : Butterworth(cycles, count());
      filter([&](std::size_t /*i*/, double white) { return sections(white); });
      return;
    }
    Decay decay(0.5 / (std::numbers::pi * cutoff_hz));
    std::array<double, most_poles> filtered{};
    const std::size_t poles_of_all = count();
    filter([&](std::size_t i, double white) {
      const std::size_t to = std::max<std::size_t>(i, 1);
      const double pole = decay.over(series.t_s[to] - series.t_s[to - 1]);
      for (std::size_t k = 0; k < poles_of_all; ++k)
        white = filtered[k] = i == 0 ? white * std::sqrt((1.0 - pole) / (1.0 + pole))
                                     : pole * filtered[k] + (1.0 - pole) * white;
      return white;
    });
  }

  std::size_t sampled_poles() const {
    return static_cast<std::size_t>(
        std::clamp(std::lround(poles), 1L, static_cast<long>(SampledLowPass::most_poles)));
  }
  /// One pole is, sampled, a recursion.
  bool is_folded() const {
    return continuous > 0.5 && (poles > 1.5 || maximally_flat > 0.5 || damping_ratio > 0.0);
  }
};

}  // namespace gyrostat::effects
