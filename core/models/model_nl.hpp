#pragma once

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// Prior of the parameters that model NL carries as states.
template <class T>
struct InitialParameterStates {
  T initial_phi_std{0.1};
  T initial_delta1_std_dps{0.0005};
  T initial_delta2_std_dps{0.0005};

  static constexpr auto fields() {
    using P = InitialParameterStates;
    return std::array{
        Field{"initial_phi_std", &P::initial_phi_std, "1", ranges::non_negative,
              "initial standard deviation of phi"},
        Field{"initial_delta1_std_dps", &P::initial_delta1_std_dps, "dps", ranges::non_negative,
              "initial standard deviation of delta1"},
        Field{"initial_delta2_std_dps", &P::initial_delta2_std_dps, "dps", ranges::non_negative,
              "initial standard deviation of delta2"},
    };
  }
};

/// Model NL of [A eq. 5-6], augmented with its noise: X = [x_k, x_{k-1}, phi, delta1, delta2, a_k,
/// a_{k-1}]. phi, delta1 and delta2 are constant states; the noise enters through products.
///
/// What its structure lets a filter rely on, where the noise starts every step with zero mean, unit
/// covariance and no correlation with the rest:
/// - Rows x_{k-1} (the old x) and phi (itself) are linear; row x is quadratic.
/// - Neither the sigma points nor the measurement of x correlate delta1 and delta2 with anything:
///   delta a is a product of two independent states, which no pair of symmetric points excites.
///   They keep mean and variance, so x, x_{k-1} and phi are the `coupled` states and the noise is
///   all that drives them.
template <class T>
struct ModelNl {
  static constexpr int states = 5;
  static constexpr int augmented = 7;
  static constexpr int coupled = 3;
  using State = Vector<T, augmented>;
  using Coupled = Vector<T, coupled>;

  static State transition(const State& s) {
    State next = s;
    next(0) = (T(1.0) + s(2)) * s(0) - s(2) * s(1) + s(3) * s(5) - s(4) * s(6);
    next(1) = s(0);
    return next;
  }

  /// Row x of the Jacobian at a mean of the coupled states.
  static Coupled gradient(const Coupled& s) { return {T(1.0) + s(2), -s(2), s(0) - s(1)}; }
  /// The second-order part of row x along d.
  static T curvature(const T& d_x, const T& d_x_previous, const T& d_phi) {
    return d_phi * (d_x - d_x_previous);
  }
  /// Variance of what the noise adds to x.
  static T drive(const T& delta1, const T& delta2) { return delta1 * delta1 + delta2 * delta2; }
};

}  // namespace gyrostat
