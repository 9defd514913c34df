#pragma once

#include <gyrostat/core/models/thermal_drift.hpp>
#include <gyrostat/core/numerics/kalman.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// [a, b, c].
template <class T>
Vector<T, 3> coefficients_of(const ThermalDrift<T>& drift) {
  return {drift.a_dps_per_C, drift.b_dps_s_per_C, drift.c_dps};
}

/// What every thermal method is told: initial coefficients with their uncertainty, and the compass.
template <class T>
struct ThermalParameters : ThermalDrift<T> {
  T initial_a_std_dps_per_C{0.001};
  T initial_b_std_dps_s_per_C{0.1};
  T initial_c_std_dps{0.05};
  T bias_measurement_std_dps{0.01};
  T update_interval_s{10.0};
  T follows_temperature{0.0};
  T keeps_bias{0.0};

  static constexpr auto fields() {
    using P = ThermalParameters;
    return join_fields<P, T>(
        ThermalDrift<T>::fields(),
        std::array{
            Field{"initial_a_std_dps_per_C", &P::initial_a_std_dps_per_C, "dps/°C",
                  ranges::positive, "initial standard deviation of a"},
            Field{"initial_b_std_dps_s_per_C", &P::initial_b_std_dps_s_per_C, "dps·s/°C",
                  ranges::positive, "initial standard deviation of b"},
            Field{"initial_c_std_dps", &P::initial_c_std_dps, "dps", ranges::positive,
                  "initial standard deviation of c"},
            Field{"bias_measurement_std_dps", &P::bias_measurement_std_dps, "dps", ranges::positive,
                  "standard deviation of one bias measurement M"},
            Field{"update_interval_s", &P::update_interval_s, "s", ranges::positive,
                  "time between compass updates"},
            Field{
                "follows_temperature", &P::follows_temperature, "1", ranges::flag,
                "between updates, 1: a, b, c are held and the bias follows T; 0: the bias is held"},
            Field{"keeps_bias", &P::keeps_bias, "1", ranges::flag,
                  "where an update fails for want of a compass, 1: the last bias stays; 0: it "
                  "follows T and T' by the last a, b, c"},
        });
  }

  Vector<T, 3> coefficients() const { return coefficients_of<T>(*this); }
  Matrix<T, 3> initial_covariance() const {
    const Vector<T, 3> std{initial_a_std_dps_per_C, initial_b_std_dps_s_per_C, initial_c_std_dps};
    return std.cwiseAbs2().asDiagonal();
  }
};

/// Random walk of the coefficients, per update.
template <class T>
struct CoefficientWalk {
  T process_a_std_dps_per_C{1e-5};
  T process_b_std_dps_s_per_C{1e-3};
  T process_c_std_dps{5e-4};

  static constexpr auto fields() {
    using P = CoefficientWalk;
    return std::array{
        Field{"process_a_std_dps_per_C", &P::process_a_std_dps_per_C, "dps/°C",
              ranges::non_negative, "standard deviation of the change of a between updates"},
        Field{"process_b_std_dps_s_per_C", &P::process_b_std_dps_s_per_C, "dps·s/°C",
              ranges::non_negative, "standard deviation of the change of b between updates"},
        Field{"process_c_std_dps", &P::process_c_std_dps, "dps", ranges::non_negative,
              "standard deviation of the change of c between updates"},
    };
  }

  Matrix<T, 3> covariance() const {
    const Vector<T, 3> std{process_a_std_dps_per_C, process_b_std_dps_s_per_C, process_c_std_dps};
    return std.cwiseAbs2().asDiagonal();
  }
};

/// Coefficients [a, b, c] and their covariance.
template <class T>
using Coefficients = Gaussian<T, 3>;

}  // namespace gyrostat
