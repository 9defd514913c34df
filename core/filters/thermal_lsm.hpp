#pragma once

#include <deque>

#include <Eigen/Cholesky>

#include <gyrostat/core/models/thermal_compensator.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat::filters {

template <class T>
struct ThermalLsmParameters : ThermalParameters<T> {
  T window_points{30.0};

  static constexpr auto fields() {
    using P = ThermalLsmParameters;
    return join_fields<P, T>(
        ThermalParameters<T>::fields(),
        std::array{Field{"window_points", &P::window_points, "1", ranges::count,
                         "number of recent bias measurements that the refit uses"}});
  }
};

template <class T>
class LsmRule {
 public:
  using Parameters = ThermalLsmParameters<T>;
  static constexpr std::string_view title = "thermal drift by least squares over recent points";
  static constexpr Role role{.corrects = Role::Corrects::thermal_drift, .published = 3};

  explicit LsmRule(const Parameters& p)
      : p_(p), coefficients_{p.coefficients(), p.initial_covariance()} {}

  std::optional<Innovation<T, 1>> update(const BiasEpoch<T>& epoch) {
    if (!epoch.is_valid()) return std::nullopt;
    const auto& h = epoch.regressors;
    Innovation<T, 1> innovation;
    innovation.sound = true;
    innovation.value(0) = epoch.bias_dps - h.dot(coefficients_.mean);
    innovation.covariance(0) = p_.bias_measurement_std_dps * p_.bias_measurement_std_dps +
                               h.dot(coefficients_.covariance * h);
    window_.push_back(epoch);
    if (T(static_cast<double>(window_.size())) > p_.window_points) window_.pop_front();
    refit();
    return innovation;
  }

  const Coefficients<T>& coefficients() const { return coefficients_; }

 private:
  /// The window's points and the initial coefficients, each weighted by its variance. The prior
  /// decides only what the window cannot, as at constant temperature, where T and 1 are collinear.
  void refit() {
    const T weight = T(1.0) / (p_.bias_measurement_std_dps * p_.bias_measurement_std_dps);
    const Vector<T, 3> prior = p_.initial_covariance().diagonal().cwiseInverse();
    Matrix<T, 3> information = prior.asDiagonal();
    Vector<T, 3> pull = Vector<T, 3>::Zero();  // information times the change from the prior
    for (const auto& point : window_) {
      const auto& h = point.regressors;
      information += weight * h * h.transpose();
      pull += weight * (point.bias_dps - h.dot(p_.coefficients())) * h;
    }
    const auto factor = information.ldlt();
    coefficients_.mean = p_.coefficients() + factor.solve(pull);
    coefficients_.covariance = factor.solve(Matrix<T, 3>::Identity());
  }

  Parameters p_;
  std::deque<BiasEpoch<T>> window_;
  Coefficients<T> coefficients_;
};

/// Improved least squares [B]: refitted at every update from a limited number of recent points.
template <class T>
using ThermalLsm = ThermalCompensator<T, LsmRule<T>>;

}  // namespace gyrostat::filters
