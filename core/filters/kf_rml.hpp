#pragma once

#include <gyrostat/core/models/arima_learner.hpp>
#include <gyrostat/core/models/arima_minimal.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

template <class T>
struct KfRmlParameters : RandomErrorParameters<T>, LearningParameters<T> {
  static constexpr auto fields() {
    return join_fields<KfRmlParameters, T>(RandomErrorParameters<T>::fields(),
                                           LearningParameters<T>::fields());
  }
};

/// KfMa that learns phi, delta1, delta2 and R as it goes, by recursive maximum likelihood: what [A]
/// claims of its filters and model NL cannot do. Without initial doubt it is KfMa.
///
/// An innovation above five deviations moves the estimate as any other, but its weight in learning
/// is that of five, its gain counts as constant in the sensitivities, and those that follow it on
/// the heels teach nothing: after an outlier or a jump they are the error of the state, not of the
/// model.
template <class T>
class KfRml {
  using Number = typename ArimaLearner<T>::Number;

 public:
  using Scalar = T;
  using Parameters = KfRmlParameters<T>;
  static constexpr std::string_view title =
      "MA-exact Kalman filter that learns phi, delta1, delta2 and R by recursive maximum "
      "likelihood";
  static constexpr Needs needs{};
  static constexpr Role role{};

  explicit KfRml(const Parameters& p)
      : learner_(p, p), model_(learner_.model()), state_(model_, p) {}

  void predict() { state_.predict(model_); }

  /// z in dps, or NaN for a missing sample.
  Step<T> update(const T& z) {
    Step<T> step{.estimate_dps = state_.x.value,
                 .estimate_variance = state_.Pxx.value,
                 .status = Status::no_measurement};
    if (is_missing(z)) return step;
    const Number R = model_.measurement_noise_std_dps * model_.measurement_noise_std_dps;
    const Number innovation = Number(z) - state_.x, variance = state_.Pxx + R;
    if (!(variance.value > T(0.0))) {
      step.status = Status::indefinite_covariance;
      return step;
    }
    const bool large = ArimaLearner<T>::is_large(innovation, variance);
    auto next = state_;
    correct(next, innovation, R, variance, large);
    if (!is_finite(next)) {
      step.status = Status::not_finite;
      return step;
    }
    state_ = next;
    if (!(large && was_large_)) learner_.learn(innovation, variance);
    was_large_ = large;
    model_ = learner_.model();
    return {.estimate_dps = state_.x.value,
            .estimate_variance = state_.Pxx.value,
            .innovation_dps = innovation.value,
            .innovation_variance = variance.value};
  }

  Step<T> step(const Sample<T>& sample) {
    predict();
    return update(sample.gyro_dps);
  }

  /// The parameters as learnt so far.
  Arima111<T> model() const {
    return {.phi = model_.phi.value,
            .delta1_dps = model_.delta1_dps.value,
            .delta2_dps = model_.delta2_dps.value,
            .measurement_noise_std_dps = model_.measurement_noise_std_dps.value};
  }

  LearnedParameters learned() const requires std::same_as<T, double> {
    const auto now = model();
    return {now.phi, learner_.phi_std(), now.delta1_dps, now.delta2_dps};
  }

 private:
  static void correct(ArimaMinimal<Number>& state, const Number& innovation, const Number& R,
                      const Number& variance, bool large) {
    Number gain_x = state.Pxx / variance, gain_e = state.Pxe / variance;
    if (large) {
      gain_x.gradient.setZero();
      gain_e.gradient.setZero();
    }
    state.x += gain_x * innovation;
    state.e += gain_e * innovation;
    state.condition(R, variance);
  }

  static bool is_finite(const ArimaMinimal<Number>& s) {
    return isfinite(s.x) && isfinite(s.e) && isfinite(s.Pxx) && isfinite(s.Pxe) && isfinite(s.Pee);
  }

  ArimaLearner<T> learner_;
  Arima111<Number> model_;
  ArimaMinimal<Number> state_;
  bool was_large_ = false;
};

}  // namespace gyrostat::filters
