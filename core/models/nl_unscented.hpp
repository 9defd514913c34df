#pragma once

#include <array>

#include <gyrostat/core/models/model_nl.hpp>
#include <gyrostat/core/numerics/companion_root.hpp>
#include <gyrostat/core/numerics/kalman.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/numerics/unscented.hpp>
#include <gyrostat/core/step.hpp>

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

/// Risk parameters of the seven states, and which of them act on any lane.
template <class T>
struct NlRisk {
  explicit NlRisk(const Vector<T, 7>& mu) : twice_mu(T(2.0) * mu) {
    for (int i = 0; i < 7; ++i) acts[i] = !vanishes(mu(i));
    for (int i = 3; i < 7; ++i) on_noise_or_delta = on_noise_or_delta || acts[i];
  }

  Vector<T, 7> twice_mu;
  std::array<bool, 7> acts{};
  bool on_noise_or_delta = false;
};

/// Square-root unscented filtering of model NL augmented with its noise (n = 7) [A eq. 12-20]: the
/// steps that the SR-UKF and the SR-RSUKF are made of. Of the lower triangular root of all seven
/// states what the model's structure (see ModelNl) leaves to be computed is kept: that of the
/// coupled states, and the standard deviations of delta1 and delta2. Masks say in which lanes a
/// step exists.
template <class T>
class NlUnscented {
 public:
  static constexpr int n = ModelNl<T>::augmented;
  static constexpr int coupled = ModelNl<T>::coupled;
  using State = Vector<T, n>;
  using Root = Matrix<T, n>;

  explicit NlUnscented(const NlParameters<T>& p)
      : transform_(n, p.alpha, p.beta, p.kappa),
        noise_std_(p.measurement_noise_std_dps),
        mean_(p.initial_x_dps, p.initial_x_previous_dps, p.phi),
        root_(Matrix<T, coupled>::Zero()),
        delta_(p.delta1_dps, p.delta2_dps),
        delta_std_(p.initial_delta1_std_dps, p.initial_delta2_std_dps) {
    root_.diagonal() << p.initial_x_std_dps, p.initial_x_previous_std_dps, p.initial_phi_std;
  }

  /// Sigma points through the model. [A eq. 14] prints the central term of the covariance without
  /// "- mean": mended. Where the downdate that it stands for does not exist, false, and the state
  /// is of no use.
  [[nodiscard]] Mask<T> time_update() {
    Vector<T, coupled> q;
    unrolled<coupled>([&]<int j>() { q(j) = ModelNl<T>::curvature(at(0, j), at(1, j), at(2, j)); });
    const T x = mean_(0);
    const Mask<T> exists = companion_root<T>(root_, ModelNl<T>::gradient(mean_),
                                             ModelNl<T>::drive(delta_(0), delta_(1)),
                                             transform_.template variance<coupled>(q));
    mean_(0) =
        (T(1.0) + mean_(2)) * x - mean_(2) * mean_(1) + transform_.template shift<coupled>(q);
    mean_(1) = x;
    return exists;
  }

  /// Adds a random step of these standard deviations to phi, delta1 and delta2.
  void walk_parameters(const Vector<T, 3>& std) {
    root_(2, 2) = hypotenuse(root_(2, 2), std(0));
    for (int i = 0; i < 2; ++i) delta_std_(i) = hypotenuse(delta_std_(i), std(1 + i));
  }

  /// Takes these for delta1, delta2 and sqrt(R).
  void set_noise(const T& delta1, const T& delta2, const T& measurement_noise_std) {
    delta_ << delta1, delta2;
    noise_std_ = measurement_noise_std;
  }

  /// P <- (P^-1 - 2 diag(mu))^-1. False, with nothing changed, where that does not exist.
  [[nodiscard]] Mask<T> risk_update(const NlRisk<T>& risk) {
    NlUnscented next = *this;
    Mask<T> exists = true;
    if (risk.on_noise_or_delta) {
      NlUnscented wider = *this;
      exists = wider.inflate_noise_and_delta(NlRisk<T>(risk));
      next = wider;
    }
    unrolled<coupled>([&]<int i>() {
      if (risk.acts[i])
        exists = inflate_along<i, T, coupled>(next.root_, risk.twice_mu(i)) && exists;
    });
    *this = select(exists, next, *this);
    return exists;
  }

  /// z = x_k + v, with points redrawn from the predicted state.
  ///
  /// The measurement is state 0 and the root lower triangular, so the points' z lie at x and at
  /// x +- gamma root_(0, 0): S_z^2 = root_(0, 0)^2 + R and P_xz = root_(0, 0) root_(:, 0), whatever
  /// the weights are. The downdate by U = K S_z ([A eq. 20] prints P_xz S_z: mended) then concerns
  /// column 0 alone and scales it by sqrt(R) / S_z, which cannot lose definiteness. Where S_z is
  /// zero `sound` is false and the state of no use.
  Innovation<T, 1> measurement_update(const T& z) {
    using std::sqrt;
    Innovation<T, 1> innovation;
    innovation.value(0) = z - mean_(0);
    innovation.covariance(0) = root_(0, 0) * root_(0, 0) + noise_std_ * noise_std_;
    const T& variance = innovation.covariance(0);
    innovation.sound = variance > T(0.0);
    const T per_deviation = T(1.0) / sqrt(variance);
    mean_ += root_.col(0) * (root_(0, 0) * per_deviation * (per_deviation * innovation.value(0)));
    root_.col(0) *= noise_std_ * per_deviation;
    return innovation;
  }

  Mask<T> is_finite() const {
    using std::isfinite;
    T sum = delta_std_(0) + delta_std_(1);
    unrolled<coupled>([&]<int i>() { sum += mean_(i); });
    unrolled<coupled * coupled>([&]<int at>() {
      if constexpr (at / coupled >= at % coupled) sum += root_(at / coupled, at % coupled);
    });
    return isfinite(sum);
  }

  T estimate() const { return mean_(0); }
  T variance() const { return root_(0, 0) * root_(0, 0); }
  Learned<T> learned() const {
    using std::sqrt;
    const Vector<T, coupled> row = root_.row(2).transpose();
    return {mean_(2), sqrt(ordered_dot<T, coupled>(row, row)), delta_(0), delta_(1)};
  }
  /// Of all seven states, after a noise reset.
  State mean() const {
    State mean = State::Zero();
    mean << mean_, delta_, T(0.0), T(0.0);
    return mean;
  }
  Root root() const {
    Root root = Root::Identity();
    root.template topLeftCorner<coupled, coupled>() = root_;
    root.diagonal().template segment<2>(coupled) = delta_std_;
    return root;
  }

  friend NlUnscented select(const Mask<T>& mask, const NlUnscented& yes, const NlUnscented& no) {
    NlUnscented out = yes;
    out.mean_ = gyrostat::select(mask, yes.mean_, no.mean_);
    out.root_ = gyrostat::select(mask, yes.root_, no.root_);
    out.delta_std_ = gyrostat::select(mask, yes.delta_std_, no.delta_std_);
    return out;
  }

 private:
  /// delta1 and delta2 stand alone. Risk of the noise is as if it had been drawn with variance
  /// 1 / (1 - 2 mu), which x alone feels. Out of line and on copies, so that the filter stays in
  /// registers where there is no such risk.
  [[gnu::noinline]] Mask<T> inflate_noise_and_delta(const NlRisk<T>& risk) {
    using std::sqrt;
    Mask<T> exists = true;
    for (int i = 0; i < 2; ++i) {
      const T &twice_delta = risk.twice_mu(3 + i), &twice_noise = risk.twice_mu(5 + i);
      const T delta_rest = T(1.0) - twice_delta * (delta_std_(i) * delta_std_(i));
      const T noise_rest = T(1.0) - twice_noise;
      exists = exists && delta_rest > T(0.0) && noise_rest > T(0.0);
      if (risk.acts[3 + i]) delta_std_(i) /= sqrt(delta_rest);
      if (risk.acts[5 + i])
        update_root<T, coupled>(
            root_, Vector<T, coupled>::Unit(0) * T(delta_(i) * sqrt(twice_noise / noise_rest)));
    }
    return exists;
  }

  static T hypotenuse(const T& a, const T& b) {
    using std::sqrt;
    return select(vanishing(b), a, T(sqrt(a * a + b * b)));
  }
  T at(int i, int j) const { return i < j ? T(0.0) : root_(i, j); }

  UnscentedQuadratic<T> transform_;
  T noise_std_;
  Vector<T, coupled> mean_;
  Matrix<T, coupled> root_;
  Vector<T, 2> delta_, delta_std_;
};

/// One cycle: time update, risk update where `risk` is given, measurement update, noise reset
/// (which the structure has made already: the noise is not carried).
template <class T>
Step<T> nl_cycle(NlUnscented<T>& filter, const T& z, const NlRisk<T>* risk = nullptr) {
  Step<T> step;
  NlUnscented<T> next = filter;
  const Mask<T> predicted = next.time_update(), present = !is_missing(z);
  Mask<T> inflated = true, sound = true;
  if (risk != nullptr) inflated = next.risk_update(*risk);
  Innovation<T, 1> innovation;
  if (any(present)) {
    NlUnscented<T> updated = next;
    innovation = updated.measurement_update(z);
    sound = innovation.sound || !present;
    next = select(present && sound, updated, next);
  }
  const Mask<T> finite = next.is_finite(), made = predicted && finite;
  filter = select(made, next, filter);

  const Mask<T> informed = made && present && sound;
  step.estimate_dps = filter.estimate();
  step.estimate_variance = filter.variance();
  step.innovation_dps = select(informed, innovation.value(0), step.innovation_dps);
  step.innovation_variance = select(informed, innovation.covariance(0), step.innovation_variance);
  set_status(step.status, !present, Status::no_measurement);
  set_status(step.status, !inflated, Status::risk_breakdown);
  set_status(step.status, !sound, Status::indefinite_covariance);
  set_status(step.status, !finite, Status::not_finite);
  set_status(step.status, !predicted, Status::indefinite_covariance);
  return step;
}

}  // namespace gyrostat
