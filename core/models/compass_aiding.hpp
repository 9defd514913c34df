#pragma once

#include <optional>

#include <gyrostat/core/held/held_interval.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// One epoch of compass aiding: the regressors [T, T', 1] there and, where the compass allows, the
/// bias M measured over the interval that ends there.
template <class T>
struct BiasEpoch {
  Vector<T, 3> regressors;
  T bias_dps{no_value};

  bool is_valid() const { return !is_missing(bias_dps); }
};

/// Turns compass headings and the gyro into bias measurements [B]:
///   M_k = B_{k-1} - wrap(change of A_c - A_g over the interval) / dt,
/// with A_c the compass heading and A_g the integral of gyro - B_{k-1}, B_{k-1} the bias estimate
/// held over the interval. A gyro bias above the estimate turns A_g ahead of A_c, so the difference
/// falls: hence the minus. T' is the difference of T over the interval [B eq. 5].
template <class T>
class CompassAiding {
 public:
  explicit CompassAiding(const T& update_interval_s) : least_s_(update_interval_s - T(1e-6)) {}

  /// The epoch that this sample completes, if it does. The first sample is epoch 0, without a bias.
  std::optional<BiasEpoch<T>> observe(const Sample<T>& sample, const T& held_bias_dps) {
    if (is_missing(start_.t_s)) return begin(sample);
    turned_deg_ += (sample.gyro_dps - held_bias_dps) * (sample.t_s - last_t_s_);
    last_t_s_ = sample.t_s;
    const T elapsed = sample.t_s - start_.t_s;
    if (elapsed < least_s_) return std::nullopt;

    BiasEpoch<T> epoch = begin_epoch(sample, elapsed);
    epoch.bias_dps = held_bias_dps -
                     wrap_degrees(sample.heading_deg - start_.heading_deg - turned_deg_) / elapsed;
    start_ = sample;
    turned_deg_ = T(0.0);
    return epoch;
  }

  /// Between epochs it only integrates; without what is held meanwhile.
  HeldInterval<T> held() const {
    return {
        .from_s = start_.t_s, .least_s = least_s_, .last_s = last_t_s_, .turned_deg = turned_deg_};
  }
  void resume(const HeldInterval<T>& held) {
    last_t_s_ = held.last_s;
    turned_deg_ = held.turned_deg;
  }

 private:
  BiasEpoch<T> begin(const Sample<T>& sample) {
    start_ = sample;
    last_t_s_ = sample.t_s;
    return begin_epoch(sample, T(1.0));
  }

  /// A missing temperature repeats the last one.
  BiasEpoch<T> begin_epoch(const Sample<T>& sample, const T& elapsed) {
    const T previous = temperature_C_;
    if (!is_missing(sample.temperature_C)) temperature_C_ = sample.temperature_C;
    const T slope = is_missing(previous) ? T(0.0) : (temperature_C_ - previous) / elapsed;
    return {.regressors = {is_missing(temperature_C_) ? T(0.0) : temperature_C_, slope, T(1.0)}};
  }

  T least_s_;
  Sample<T> start_;
  T last_t_s_{no_value};
  T temperature_C_{no_value};
  T turned_deg_{0.0};
};

}  // namespace gyrostat
