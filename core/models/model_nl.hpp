#pragma once

#include "core/models/arima111.hpp"

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
template <class T>
struct ModelNl {
  static constexpr int states = 5;
  static constexpr int augmented = 7;
  using State = Vector<T, augmented>;

  static State transition(const State& s) {
    State next = s;
    next(0) = (T(1.0) + s(2)) * s(0) - s(2) * s(1) + s(3) * s(5) - s(4) * s(6);
    next(1) = s(0);
    return next;
  }

  /// transition(s + d) - transition(s), exactly: without the cancellation that close sigma points
  /// (a small alpha) would suffer.
  static State increment(const State& s, const State& d) {
    State next = d;
    next(0) = (T(1.0) + s(2)) * d(0) - s(2) * d(1) + d(2) * (s(0) - s(1)) + d(2) * (d(0) - d(1)) +
              s(3) * d(5) + d(3) * (s(5) + d(5)) - s(4) * d(6) - d(4) * (s(6) + d(6));
    next(1) = d(0);
    return next;
  }
};

}  // namespace gyrostat
