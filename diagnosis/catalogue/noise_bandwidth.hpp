#pragma once

#include <array>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/noise_bandwidth.hpp>

namespace gyrostat::gap {

/// Noise through a low-pass filter of one to four poles, forward and back, of two that ring, or of
/// two before it was sampled, each a start of its own.
template <>
struct Diagnosed<effects::NoiseBandwidth> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseBandwidth::cutoff_hz,
                                                 &effects::NoiseBandwidth::after_dps,
                                                 &effects::NoiseBandwidth::damping_ratio};
  static constexpr std::string_view part = "output filter";
  static constexpr std::array alike = {&effects::NoiseBandwidth::cutoff_hz,
                                       &effects::NoiseBandwidth::damping_ratio};

  /// Its poles are, and of what time it is; one that is neither Butterworth's nor of equal poles is
  /// seldom built, and what it may take the form of is much.
  static std::size_t chosen_parameters(const effects::NoiseBandwidth& effect) {
    return 1 + (effect.continuous > 0.5 ? 1 : 0) + (effect.zero_phase > 0.5 ? 1 : 0) +
           (effect.damping_ratio > 0.0 ? 4 : 0);
  }
  static std::vector<effects::NoiseBandwidth> guesses(const Beside& beside) {
    std::vector<effects::NoiseBandwidth> all;
    for (const double flat : {0.0, 1.0})
      for (const double poles : {1.0, 2.0, 3.0, 4.0})
        for (const double share : {0.03, 0.1, 0.25})
          all.push_back(
              {share * beside.conditions.rate_hz() * (flat > 0.5 ? 1.0 : std::sqrt(poles)), poles,
               flat});
    for (const double flat : {0.0, 1.0})
      for (const double share : {0.2, 0.6})
        all.push_back({share * beside.conditions.rate_hz() * (flat > 0.5 ? 1.0 : std::sqrt(2.0)),
                       2.0, flat, 1.0});
    for (const double poles : {1.0, 2.0, 4.0})
      for (const double share : {0.1, 0.25})
        all.push_back({.cutoff_hz = share * beside.conditions.rate_hz(),
                       .poles = poles,
                       .maximally_flat = 1.0,
                       .zero_phase = 1.0});
    // What rings and has no noise after it is less than a line beside an average.
    const auto& c = beside.conditions;
    const double after_dps = 0.3 * noise_of_steps(c, c.series().gyro_dps);
    for (const double share : {0.03, 0.1, 0.25})
      for (const double after : {0.0, after_dps})
        all.push_back({.cutoff_hz = share * c.rate_hz(),
                       .poles = 2.0,
                       .after_dps = after,
                       .damping_ratio = 0.4});
    return all;
  }

  /// With white noise after it, which a line, a second filter or more poles would stand in for, or
  /// without; of any damping, or of Butterworth's.
  static std::vector<effects::NoiseBandwidth> told_otherwise(const effects::NoiseBandwidth& effect,
                                                             const Conditions& c) {
    using Filter = effects::NoiseBandwidth;
    const double after_dps = 0.5 * noise_of_steps(c, c.series().gyro_dps);
    std::vector<Filter> all;
    const auto add = [&](Filter form, double after) {
      form.cutoff_hz = effect.cutoff_hz;
      form.after_dps = after;
      all.push_back(form);
    };
    constexpr double damping_ratio = 0.85;
    constexpr double next_to_none = 1e-3;  // where a fit has left it for good
    if (effect.after_dps > next_to_none * after_dps) {
      all.push_back(effect);
      all.back().after_dps = 0.0;
    } else {
      add({.poles = 1.0}, after_dps);
      add({.poles = 2.0}, after_dps);
      add({.poles = 2.0, .maximally_flat = 1.0}, after_dps);
      add({.poles = 2.0, .maximally_flat = 1.0, .continuous = 1.0}, after_dps);
    }
    if (effect.damping_ratio > 0.0) {
      add({.poles = 2.0, .maximally_flat = 1.0}, effect.after_dps);
    } else {
      add({.poles = 2.0, .damping_ratio = damping_ratio}, effect.after_dps);
      if (effect.after_dps == 0.0) add({.poles = 2.0, .damping_ratio = damping_ratio}, after_dps);
    }
    return all;
  }

  static void enter(const effects::NoiseBandwidth& effect, NoiseLaw& law) {
    law.filter = effect;
    law.rounding += effect.after_dps * effect.after_dps;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// No output filter rings for long: with white noise after it, it were a line. One of
  /// Butterworth's poles at a quarter of the rate is the mean of two samples.
  static bool is_what_it_is_called(const effects::NoiseBandwidth& effect, const Conditions& c) {
    constexpr double least_damping = 0.25, near_a_quarter = 0.01;
    const bool is_mean = effect.maximally_flat > 0.5 && effect.poles < 1.5 &&
                         std::abs(effect.cutoff_hz / c.rate_hz() - 0.25) < near_a_quarter;
    return !is_mean && (effect.damping_ratio == 0.0 || effect.damping_ratio >= least_damping);
  }
};

}  // namespace gyrostat::gap
