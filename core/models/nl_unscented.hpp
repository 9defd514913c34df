#pragma once

#include <optional>

#include "core/models/model_nl.hpp"
#include "core/numerics/cholesky.hpp"
#include "core/numerics/kalman.hpp"
#include "core/numerics/unscented.hpp"
#include "core/step.hpp"

namespace gyrostat {

/// Spread of the sigma points (Wan and van der Merwe 2000).
template <class T>
struct UnscentedParameters {
  T alpha{1.0};
  T beta{2.0};
  T kappa{0.0};

  static constexpr auto fields() {
    using P = UnscentedParameters;
    return std::array{
        Field{"alpha", &P::alpha, "1", Range{.from = 1e-4, .to = 10},
              "spread of the sigma points around the mean"},
        Field{"beta", &P::beta, "1", ranges::non_negative,
              "weight of the central point in the covariance; 2 suits a Gaussian"},
        Field{"kappa", &P::kappa, "1", Range{.from = -7, .open_from = true},
              "secondary spread; the points lie at alpha sqrt(7 + kappa) standard deviations"},
    };
  }
};

template <class T>
struct NlParameters : RandomErrorParameters<T>, InitialParameterStates<T>, UnscentedParameters<T> {
  static constexpr auto fields() {
    return join_fields<NlParameters, T>(RandomErrorParameters<T>::fields(),
                                        InitialParameterStates<T>::fields(),
                                        UnscentedParameters<T>::fields());
  }
};

/// Square-root unscented filtering of model NL augmented with its noise (n = 7) [A eq. 12-20]: the
/// steps that the SR-UKF and the SR-RSUKF are made of. The root is lower triangular.
template <class T>
class NlUnscented {
 public:
  static constexpr int n = ModelNl<T>::augmented;
  using State = Vector<T, n>;
  using Root = Matrix<T, n>;

  explicit NlUnscented(const NlParameters<T>& p)
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
      deviations.col(i) = ModelNl<T>::increment(mean_, d);
      deviations.col(n + i) = ModelNl<T>::increment(mean_, -d);
    }
    const State shift = weights_.other * deviations.rowwise().sum();
    Root root = lower_root<T, n, 2 * n>(sqrt(weights_.other) * (deviations.colwise() - shift));
    if (!add_centre(root, shift)) return false;
    mean_ = ModelNl<T>::transition(mean_) + shift;
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
  [[nodiscard]] bool risk_update(const State& mu) { return inflate_root<T, n>(root_, mu); }

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

  /// The noise states back to zero mean and unit covariance, their correlation with the rest dropped.
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
  LearnedParameters learned() const
    requires std::same_as<T, double>
  {
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
Step<T> nl_cycle(NlUnscented<T>& filter, const std::optional<Vector<T, 7>>& mu, const T& z) {
  Status status = Status::ok;
  NlUnscented<T> next = filter;
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

}  // namespace gyrostat
