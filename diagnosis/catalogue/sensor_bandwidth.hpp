#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>

namespace gyrostat::gap {

/// The rate through a low-pass filter of one or two poles, of continuous time or over samples, or a
/// mean, each a start of its own; two poles of any damping from Butterworth's; and of rarer forms
/// the likeliest.
template <>
struct Diagnosed<effects::SensorBandwidth> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SensorBandwidth::cutoff_hz,
                                                 &effects::SensorBandwidth::damping_ratio,
                                                 &effects::SensorBandwidth::before_dps};

  /// One pole is what else would be expected: another form is chosen.
  static std::size_t chosen_parameters(const effects::SensorBandwidth& effect) {
    if (effect.zero_phase > 0.5 || effect.averages > 1.5 || effect.poles > 2.5) return 2;
    const bool is_other =
        effect.averages > 0.5 || effect.maximally_flat > 0.5 || effect.poles > 1.5;
    return is_other && effect.damping_ratio == 0.0 ? 1 : 0;
  }

  static std::vector<effects::SensorBandwidth> starts(const Evidence& e) {
    const double rate_hz = e.conditions().rate_hz();
    std::vector<effects::SensorBandwidth> all;
    for (const auto& form :
         {effects::SensorBandwidth{}, effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0},
          effects::SensorBandwidth{.averages = 1.0}, effects::SensorBandwidth{.continuous = 1.0},
          effects::SensorBandwidth{.poles = 2.0, .continuous = 1.0},
          effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0, .continuous = 1.0}})
      all.push_back(of_better_course(e, form, [&](const effects::SensorBandwidth& there) {
        return shaped(e, Trace::rate, there, &effects::SensorBandwidth::cutoff_hz, 0.002 * rate_hz,
                      highest_hz(form, rate_hz));
      }));
    all.push_back(of_better_course(e, all.back(),
                                   [&](const auto& there) { return of_any_damping(e, there); }));
    if (const auto rarer = rarer_form(e, all)) all.push_back(*rarer);
    for (auto& form : all) form = begun_before(e, form);
    return all;
  }

  /// By which a slow motion is late.
  static double delay_s_of(const effects::SensorBandwidth& effect) {
    if (effect.zero_phase > 0.5) return 0.0;
    return (effect.damping_ratio > 0.0 ? 2.0 * of_pole * effect.damping_ratio
            : effect.averages > 0.5    ? of_mean
            : effect.maximally_flat > 0.5
                ? of_pole / std::sin(0.5 * std::numbers::pi / effect.poles)
                : of_pole * effect.poles) /
           effect.cutoff_hz;
  }

  /// The other forms that delay a slow motion by as much.
  static std::vector<effects::SensorBandwidth> told_otherwise(
      const effects::SensorBandwidth& effect, const Conditions& c) {
    if (effect.zero_phase > 0.5) return {};
    const double delay_s = delay_s_of(effect);
    const bool is_damped = effect.damping_ratio > 0.0, is_mean = effect.averages > 0.5,
               is_flat = !is_mean && !is_damped && effect.maximally_flat > 0.5;
    std::vector<effects::SensorBandwidth> all;
    if (!is_mean)
      all.push_back(
          {.cutoff_hz = of_mean / delay_s, .averages = 1.0, .before_dps = effect.before_dps});
    for (const double continuous : {0.0, 1.0, 2.0}) {
      const bool is_other_time = is_mean || is_damped || effect.continuous != continuous;
      const auto add = [&](effects::SensorBandwidth form) {
        form.continuous = continuous;
        form.before_dps = effect.before_dps;
        form.cutoff_hz = std::min(form.cutoff_hz, highest_hz(form, c.rate_hz()));
        all.push_back(form);
      };
      if (is_flat || is_other_time) add({.cutoff_hz = of_pole / delay_s});
      if (!is_flat || is_other_time)
        add({.cutoff_hz = of_butterworth / delay_s, .poles = 2.0, .maximally_flat = 1.0});
    }
    return all;
  }

  /// Of forms that are built less often the one that leaves least, if that is clearly less than
  /// what each of `others` leaves.
  static std::optional<effects::SensorBandwidth> rarer_form(
      const Evidence& e, const std::vector<effects::SensorBandwidth>& others) {
    constexpr double clear = 10.0;
    const double rate_hz = e.conditions().rate_hz();
    const auto seen = trace_of(e, Trace::rate);
    const auto gain_of = [&](double left) {
      return -0.5 * static_cast<double>(seen.size()) * std::log(left);
    };
    // Of what is neither late nor smoothed none is sought.
    effects::SensorBandwidth late{.cutoff_hz = 0.1 * rate_hz}, smooth = late;
    smooth.zero_phase = 1.0;
    if (gain_of(match(signatures(e, Trace::rate, {late, smooth}), seen).unexplained) < clear)
      return std::nullopt;
    auto forms = others;
    const auto try_too = [&](const effects::SensorBandwidth& form) {
      forms.push_back(shaped(e, Trace::rate, form, &effects::SensorBandwidth::cutoff_hz,
                             0.002 * rate_hz, highest_hz(form, rate_hz)));
    };
    for (const double zero_phase : {0.0, 1.0}) {
      try_too({.averages = 2.0, .zero_phase = zero_phase});
      for (const double poles : {1.0, 2.0, 3.0, 4.0})
        if (zero_phase > 0.5 || poles != 2.0)
          try_too({.poles = poles, .maximally_flat = 1.0, .zero_phase = zero_phase});
    }
    const auto left = left_by_each(e, Trace::rate, std::vector<Effect>(forms.begin(), forms.end()));
    const auto rarer = left.begin() + static_cast<std::ptrdiff_t>(others.size());
    const auto least = std::min_element(rarer, left.end());
    if (!(gain_of(*least / *std::min_element(left.begin(), rarer)) > clear)) return std::nullopt;
    return forms[static_cast<std::size_t>(least - left.begin())];
  }

  /// What `fitted` makes of the form, the rate between samples curved or straight: what leaves
  /// less.
  template <class Fit>
  static effects::SensorBandwidth of_better_course(const Evidence& e, effects::SensorBandwidth form,
                                                   const Fit& fitted) {
    if (form.continuous < 0.5) return fitted(form);
    form.continuous = 1.0;
    const auto curved = fitted(form);
    form.continuous = 2.0;
    const auto straight = fitted(form);
    const auto left = left_by_each(e, Trace::rate, {curved, straight});
    return left[1] < left[0] ? straight : curved;
  }

  /// From Butterworth's two poles, by Gauss and Newton.
  static effects::SensorBandwidth of_any_damping(const Evidence& e,
                                                 const effects::SensorBandwidth& butterworth) {
    constexpr int most_steps = 8;
    constexpr double step = 1e-3, furthest = 0.3;
    const auto seen = trace_of(e, Trace::rate);
    effects::SensorBandwidth best{.cutoff_hz = butterworth.cutoff_hz,
                                  .continuous = butterworth.continuous,
                                  .damping_ratio = 0.5 * std::numbers::sqrt2};
    double least = -1.0;
    effects::SensorBandwidth trial = best;
    for (int k = 0; k < most_steps; ++k) {
      auto faster = trial, damped = trial;
      faster.cutoff_hz *= 1.0 + step;
      damped.damping_ratio *= 1.0 + step;
      auto columns = signatures(e, Trace::rate, {trial, faster, damped});
      const Eigen::VectorXd left = seen - columns.col(0);
      if (least >= 0.0 && !(left.squaredNorm() < least)) break;
      least = left.squaredNorm();
      best = trial;
      for (const Eigen::Index c : {1, 2}) columns.col(c) -= columns.col(0);
      const Eigen::VectorXd by = step * match(columns.rightCols(2), left).amplitudes;
      trial.cutoff_hz *= std::exp(std::clamp(by[0], -furthest, furthest));
      trial.damping_ratio *= std::exp(std::clamp(by[1], -furthest, furthest));
    }
    return best;
  }

  /// At rest at another rate before the first sample, where that leaves clearly less. Beside a
  /// shift of time it would stand for what that does not know.
  static effects::SensorBandwidth begun_before(const Evidence& e, effects::SensorBandwidth form) {
    constexpr double clear = 10.0;
    for (const auto& effect : e.baseline.effects)
      if (effect.id() == "time_offset") return form;
    auto other = form;
    other.before_dps = fastest_dps(e.conditions());
    const auto columns = signatures(e, Trace::rate, {form, other});
    const auto fit =
        match(columns.col(1) - columns.col(0), trace_of(e, Trace::rate) - columns.col(0));
    if (-0.5 * static_cast<double>(columns.rows()) * std::log(fit.unexplained) > clear)
      form.before_dps = other.before_dps * fit.amplitudes[0];
    return form;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  /// What rings for long is no low-pass filter.
  static bool is_what_it_is_called(const effects::SensorBandwidth& effect,
                                   const Conditions& /*c*/) {
    constexpr double least_damping = 0.2;
    return effect.damping_ratio == 0.0 || effect.damping_ratio >= least_damping;
  }

 private:
  // Delays of a cutoff of 1 Hz, in seconds.
  static constexpr double of_pole = 0.5 / std::numbers::pi,
                          of_butterworth = of_pole * std::numbers::sqrt2,
                          of_mean = 0.5 * effects::SensorBandwidth::half_power_of_mean;

  /// Samples have no more than half their rate; what is sampled may have passed more, down to
  /// a lag of a three hundredth of a sample. Of a straight rate one of less than a twentieth is a
  /// shift.
  static constexpr double highest_hz(const effects::SensorBandwidth& form, double rate_hz) {
    return (form.continuous > 1.5 ? 3.2 : form.continuous > 0.5 ? 50.0 : 0.49) * rate_hz;
  }
};

}  // namespace gyrostat::gap
