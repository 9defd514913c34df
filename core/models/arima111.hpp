#pragma once

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// Random error x and white measurement noise v of a gyro:
///   x_k = (1 + phi) x_{k-1} - phi x_{k-2} + delta1 a_k - delta2 a_{k-1},  a_k ~ N(0, 1)
///   z_k = x_k + v_k,  v_k ~ N(0, R)
/// [A eq. 1-2]. The defaults are of the size of a consumer-grade gyro at 100 Hz.
template <class T>
struct Arima111 {
  T phi{0.3};
  T delta1_dps{0.002};
  T delta2_dps{0.001};
  T measurement_noise_std_dps{0.05};

  static constexpr auto fields() {
    using P = Arima111;
    return std::array{
        Field{"phi", &P::phi, "1", ranges::stationary,
              "autoregressive coefficient of the first difference, phi"},
        Field{"delta1_dps", &P::delta1_dps, "dps", ranges::non_negative,
              "standard deviation of the innovation a_k, delta1"},
        Field{"delta2_dps", &P::delta2_dps, "dps", ranges::any,
              "moving-average coefficient of a_{k-1}, delta2 = theta delta1"},
        Field{"measurement_noise_std_dps", &P::measurement_noise_std_dps, "dps",
              ranges::non_negative, "standard deviation of the white measurement noise, sqrt(R)"},
    };
  }

  T theta() const { return delta2_dps / delta1_dps; }
};

/// Prior of x_0 and x_{-1}, independent of each other.
template <class T>
struct InitialRandomError {
  T initial_x_dps{0.0};
  T initial_x_previous_dps{0.0};
  T initial_x_std_dps{0.1};
  T initial_x_previous_std_dps{0.1};

  static constexpr auto fields() {
    using P = InitialRandomError;
    return std::array{
        Field{"initial_x_dps", &P::initial_x_dps, "dps", ranges::any, "initial x_k"},
        Field{"initial_x_previous_dps", &P::initial_x_previous_dps, "dps", ranges::any,
              "initial x_{k-1}"},
        Field{"initial_x_std_dps", &P::initial_x_std_dps, "dps", ranges::non_negative,
              "initial standard deviation of x_k"},
        Field{"initial_x_previous_std_dps", &P::initial_x_previous_std_dps, "dps",
              ranges::non_negative, "initial standard deviation of x_{k-1}"},
    };
  }
};

/// What every filter of the random error is told.
template <class T>
struct RandomErrorParameters : Arima111<T>, InitialRandomError<T> {
  static constexpr auto fields() {
    return join_fields<RandomErrorParameters, T>(Arima111<T>::fields(),
                                                 InitialRandomError<T>::fields());
  }
};

}  // namespace gyrostat
