#pragma once

#include <optional>

#include <gyrostat/core/models/nl_unscented.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/tests/core/reference/dense_roots.hpp>

namespace gyrostat::reference {

/// Weights of the scaled unscented transform for n states (Wan and van der Merwe 2000, eq. 15):
/// lambda = alpha^2 (n + kappa) - n, points at the mean and at mean +- spread * root columns.
template <class T>
struct UnscentedWeights {
  T spread;             ///< gamma = sqrt(n + lambda)
  T covariance_centre;  ///< W0^c, negative for a small alpha
  T other;              ///< W_i, i = 1 ... 2n; W0^m is what is left to 1

  UnscentedWeights(int n, const T& alpha, const T& beta, const T& kappa) {
    using std::sqrt;
    const T scale = alpha * alpha * (T(n) + kappa);
    spread = sqrt(scale);
    covariance_centre = T(2.0) - T(n) / scale - alpha * alpha + beta;
    other = T(0.5) / scale;
  }
};

/// Model NL as a function of all seven states.
template <class T>
struct DenseModelNl {
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

/// The risk-sensitive update by one Sherman-Morrison rank-one update of the whole root an element.
template <class T, int N>
[[nodiscard]] bool inflate_by_updates(Matrix<T, N>& root, const Vector<T, N>& mu) {
  using std::sqrt;
  Matrix<T, N> inflated = root;
  for (int i = 0; i < N; ++i) {
    if (mu(i) == T(0.0)) continue;
    const Vector<T, N> p = inflated * inflated.row(i).transpose();
    const T remaining = T(1.0) - T(2.0) * mu(i) * p(i);
    if (!(remaining > T(0.0))) return false;
    update_root<T, N>(inflated, p * sqrt(T(2.0) * mu(i) / remaining));
  }
  root = inflated;
  return true;
}

/// Square-root unscented filtering of model NL augmented with its noise (n = 7) [A eq. 12-20]: the
/// same steps without any use of the model's structure: all 15 points through the model, a QR
/// decomposition of their deviations, updates and downdates of a full 7 x 7 root.
template <class T>
class DenseUnscented {
 public:
  static constexpr int n = DenseModelNl<T>::augmented;
  using State = Vector<T, n>;
  using Root = Matrix<T, n>;

  explicit DenseUnscented(const NlParameters<T>& p)
      : weights_(n, p.alpha, p.beta, p.kappa),
        noise_std_(p.measurement_noise_std_dps),
        mean_(State::Zero()),
        root_(Root::Identity()) {
    mean_.template head<5>() << p.initial_x_dps, p.initial_x_previous_dps, p.phi, p.delta1_dps,
        p.delta2_dps;
    root_.diagonal().template head<5>() << p.initial_x_std_dps, p.initial_x_previous_std_dps,
        p.initial_phi_std, p.initial_delta1_std_dps, p.initial_delta2_std_dps;
  }

  /// Sigma points through the model, as deviations from the central one: mean <- f(mean) + shift.
  /// [A eq. 14] prints the central term of the covariance without "- mean": mended.
  /// False, with nothing changed, where the downdate by the central point does not exist.
  [[nodiscard]] bool time_update() {
    using std::sqrt;
    Matrix<T, n, 2 * n> deviations;
    for (int i = 0; i < n; ++i) {
      const State d = weights_.spread * root_.col(i);
      deviations.col(i) = DenseModelNl<T>::increment(mean_, d);
      deviations.col(n + i) = DenseModelNl<T>::increment(mean_, -d);
    }
    const State shift = weights_.other * deviations.rowwise().sum();
    Root root = lower_root<T, n, 2 * n>(sqrt(weights_.other) * (deviations.colwise() - shift));
    if (!add_centre(root, shift)) return false;
    mean_ = DenseModelNl<T>::transition(mean_) + shift;
    root_ = root;
    return true;
  }

  /// Adds a random step of these standard deviations to phi, delta1 and delta2.
  void walk_parameters(const Vector<T, 3>& std) {
    for (int i = 0; i < 3; ++i) update_root<T, n>(root_, std(i) * State::Unit(2 + i));
  }

  /// Takes these for delta1, delta2 and sqrt(R).
  void set_noise(const T& delta1, const T& delta2, const T& measurement_noise_std) {
    mean_(3) = delta1;
    mean_(4) = delta2;
    noise_std_ = measurement_noise_std;
  }

  /// P <- (P^-1 - 2 diag(mu))^-1. False, with nothing changed, where that does not exist.
  [[nodiscard]] bool risk_update(const State& mu) { return inflate_by_updates<T, n>(root_, mu); }

  /// z = x_k + v, with points redrawn from the predicted state.
  ///
  /// The measurement is state 0 and the root lower triangular, so the points' z lie at mean_(0) and
  /// mean_(0) +- spread root_(0, 0): S_z^2 = root_(0, 0)^2 + R and P_xz = root_(0, 0) root_(:, 0),
  /// whatever the weights are. The downdate by U = K S_z ([A eq. 20] prints P_xz S_z: mended) then
  /// concerns column 0 alone and scales it by sqrt(R) / S_z, which cannot lose definiteness.
  /// `sound` is false, with nothing changed, where S_z is zero.
  Innovation<T, 1> measurement_update(const T& z) {
    using std::sqrt;
    Innovation<T, 1> innovation;
    innovation.value(0) = z - mean_(0);
    innovation.covariance(0) = root_(0, 0) * root_(0, 0) + noise_std_ * noise_std_;
    const T& variance = innovation.covariance(0);
    if (!(variance > T(0.0))) return innovation;
    mean_ += root_.col(0) * (root_(0, 0) / variance * innovation.value(0));
    root_.col(0) *= noise_std_ / sqrt(variance);
    innovation.sound = true;
    return innovation;
  }

  /// The noise states back to zero mean and unit covariance, their correlation with the rest
  /// dropped.
  void reset_noise() {
    mean_.template tail<2>().setZero();
    root_.template bottomRows<2>().setZero();
    root_.template bottomRightCorner<2, 2>().setIdentity();
  }

  bool is_finite() const {
    using std::isfinite;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        if (!isfinite(root_(i, j)) || !isfinite(mean_(i))) return false;
    return true;
  }

  T estimate() const { return mean_(0); }
  T variance() const { return root_(0, 0) * root_(0, 0); }
  LearnedParameters learned() const requires std::same_as<T, double> {
    return {mean_(2), root_.row(2).norm(), mean_(3), mean_(4)};
  }
  const State& mean() const { return mean_; }
  const Root& root() const { return root_; }

 private:
  /// Adds W0^c d d^T to a root; the sign of the weight decides between update and downdate.
  bool add_centre(Root& root, const State& d) const {
    using std::sqrt;
    const T& w = weights_.covariance_centre;
    if (w < T(0.0)) return downdate_root<T, n>(root, d * sqrt(-w));
    update_root<T, n>(root, d * sqrt(w));
    return true;
  }

  UnscentedWeights<T> weights_;
  T noise_std_;
  State mean_;
  Root root_;
};

/// One cycle: time update, risk update where `mu` is given, measurement update, noise reset.
template <class T>
Step<T> dense_cycle(DenseUnscented<T>& filter, const std::optional<Vector<T, 7>>& mu, const T& z) {
  Status status = Status::ok;
  DenseUnscented<T> next = filter;
  Innovation<T, 1> innovation;
  if (!next.time_update()) {
    status = Status::indefinite_covariance;
  } else {
    if (mu && !next.risk_update(*mu)) status = Status::risk_breakdown;
    if (!is_missing(z)) {
      innovation = next.measurement_update(z);
      if (!innovation.sound) status = Status::indefinite_covariance;
    } else if (status == Status::ok) {
      status = Status::no_measurement;
    }
    next.reset_noise();
    if (next.is_finite()) {
      filter = next;
    } else {
      status = Status::not_finite;
      innovation.sound = false;
    }
  }
  Step<T> step{.estimate_dps = filter.estimate(), .estimate_variance = filter.variance()};
  step.status = status;
  if (innovation.sound) {
    step.innovation_dps = innovation.value(0);
    step.innovation_variance = innovation.covariance(0);
  }
  return step;
}

}  // namespace gyrostat::reference
