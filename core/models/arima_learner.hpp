#pragma once

#include <algorithm>

#include <Eigen/Cholesky>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/models/model_nl.hpp>
#include <gyrostat/core/numerics/dual.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// What a filter that learns the random error's model is told beside the model.
template <class T>
struct LearningParameters : InitialParameterStates<T> {
  T initial_measurement_noise_std_std_dps{0.01};
  T gain_floor{1e-5};

  static constexpr auto fields() {
    using P = LearningParameters;
    return join_fields<P, T>(
        InitialParameterStates<T>::fields(),
        std::array{
            Field{"initial_measurement_noise_std_std_dps",
                  &P::initial_measurement_noise_std_std_dps, "dps", ranges::non_negative,
                  "initial standard deviation of sqrt(R)"},
            Field{"gain_floor", &P::gain_floor, "1", Range{.from = 0, .to = 1, .open_to = true},
                  "least weight of the newest sample, 1 / (samples remembered); 0 forgets nothing"},
        });
  }
};

/// Recursive maximum likelihood of ARIMA(1,1,1) + white noise (Ljung and Soderstrom 1983,
/// sec. 3.7): one Gauss-Newton step a sample on sum (log S + nu^2 / S) / 2 over the innovations nu
/// and their variances S, which the caller's filter computes on numbers that carry gradients.
///
/// What is learnt is (atanh phi, log delta1, atanh(delta2 / delta1), log sqrt R), each its initial
/// value plus its initial standard deviation times a coordinate w with prior N(0, 1): the model
/// stays stationary and invertible, a parameter without doubt stays put, the information never
/// falls below the prior's. A delta1 or R of zero has no logarithm and is kept.
///
/// Three measures against the likelihood's other basin, in which a moving average near 1 stands for
/// the white noise: the search starts one prior deviation towards white noise (delta1 lower, R
/// higher); phi and the moving average wait until the two scales have settled; and the k-th sample
/// weighs as sqrt(k), so that what a wrong model taught fades.
template <class T>
class ArimaLearner {
 public:
  static constexpr int n = 4;
  using Number = Dual<T, n>;
  using Coordinates = Vector<T, n>;

  ArimaLearner(const Arima111<T>& start, const LearningParameters<T>& p)
      : gain_floor_(p.gain_floor) {
    const Arima111<T> arima = invertible(start);
    const T &delta1 = arima.delta1_dps, &noise = arima.measurement_noise_std_dps;
    const T phi = inside(arima.phi), theta = inside(ratio(arima.delta2_dps, delta1));
    unit_ << T(1.0), delta1, T(1.0), noise;
    start_ << inverse_tanh(phi), T(0.0), inverse_tanh(theta), T(0.0);
    std_ << p.initial_phi_std / (T(1.0) - phi * phi), ratio(p.initial_delta1_std_dps, delta1),
        ratio(p.initial_delta2_std_dps, delta1) / (T(1.0) - theta * theta),
        ratio(p.initial_measurement_noise_std_std_dps, noise);
    std_ = std_.cwiseMin(Coordinates(T(uniform), T(widest), T(uniform), T(widest))).eval();
  }

  /// The model as learnt so far, with its gradient by w.
  Arima111<Number> model() const {
    const auto at = [&](int i) {
      return Number(start_(i) + std_(i) * w_(i), std_(i) * Coordinates::Unit(i));
    };
    const Number delta1 = unit_(1) * exp(at(1));
    return {.phi = tanh(at(0)),
            .delta1_dps = delta1,
            .delta2_dps = tanh(at(2)) * delta1,
            .measurement_noise_std_dps = unit_(3) * exp(at(3))};
  }

  /// Of the present estimate.
  T phi_std() const {
    using std::sqrt, std::tanh;
    const T phi = tanh(start_(0) + std_(0) * w_(0));
    const Matrix<T, n> covariance = information_.llt().solve(Matrix<T, n>::Identity());
    return (T(1.0) - phi * phi) * std_(0) * sqrt(covariance(0, 0));
  }

  /// Whether an innovation is beyond what the model can be blamed for.
  static bool is_large(const Number& innovation, const Number& variance) {
    return innovation.value * innovation.value > T(largest_nu * largest_nu) * variance.value;
  }

  /// With a = nu' / sqrt S and b = S' / (sqrt 2 S) the score is nu / sqrt S a + (1 - nu^2 / S) b /
  /// sqrt 2, and its expected information a a^T + b b^T.
  void learn(const Number& innovation, const Number& variance) {
    using std::sqrt;
    const T root = sqrt(variance.value);
    const T nu = std::clamp(T(innovation.value / root), T(-largest_nu), T(largest_nu));
    const T shape(samples_ < T(settling_samples) ? 0.0 : 1.0);
    const Coordinates open(shape, T(1.0), shape, T(1.0));
    const Coordinates a = open.cwiseProduct(innovation.gradient) / root;
    const Coordinates b =
        open.cwiseProduct(variance.gradient) / (T(std::numbers::sqrt2) * variance.value);
    samples_ += T(1.0);
    const T fading = T(0.5) / (samples_ + T(10.0));
    const T forget = fading > gain_floor_ ? fading : gain_floor_;

    const Coordinates score =
        nu * a + (T(1.0) - nu * nu) / T(std::numbers::sqrt2) * b + forget * w_;
    const Matrix<T, n> information = (T(1.0) - forget) * information_ +
                                     forget * Matrix<T, n>::Identity() + a * a.transpose() +
                                     b * b.transpose();
    Coordinates step = information.llt().solve(score);
    if (!step.allFinite()) return;
    const T longest = step.cwiseProduct(std_).cwiseAbs().maxCoeff();
    if (longest > T(longest_step)) step *= T(longest_step) / longest;
    w_ = (w_ - step).cwiseMax(T(-farthest)).cwiseMin(T(farthest)).eval();
    information_ = information;
  }

 private:
  static constexpr double settling_samples = 500.0;
  static constexpr double longest_step = 0.1;  ///< of a parameter, a sample
  static constexpr double largest_nu = 5.0;    ///< in standard deviations
  static constexpr double uniform = 0.9;       ///< deviation of atanh of a uniform on (-1, 1)
  static constexpr double widest = 2.0;        ///< deviation of a logarithm
  static constexpr double farthest = 5.0;      ///< of a coordinate
  static constexpr double edge = 1.0 - 1e-12;  ///< of phi and the moving average

  static T inside(const T& v) { return v > T(edge) ? T(edge) : v < T(-edge) ? T(-edge) : v; }
  static T inverse_tanh(const T& v) {
    using std::log;
    return T(0.5) * log((T(1.0) + v) / (T(1.0) - v));
  }
  static T ratio(const T& a, const T& b) { return b > T(0.0) ? T(a / b) : T(0.0); }

  /// The moving average with |delta2| <= delta1 that has the same autocovariances.
  static Arima111<T> invertible(Arima111<T> arima) {
    const T sign(arima.delta2_dps < T(0.0) ? -1.0 : 1.0);
    if (const T size = sign * arima.delta2_dps; size > arima.delta1_dps) {
      arima.delta2_dps = sign * arima.delta1_dps;
      arima.delta1_dps = size;
    }
    return arima;
  }

  T gain_floor_;
  Coordinates unit_, start_, std_;
  Coordinates w_{T(0.0), T(-1.0), T(0.0), T(1.0)};
  Matrix<T, n> information_ = Matrix<T, n>::Identity();
  T samples_{0.0};
};

}  // namespace gyrostat
