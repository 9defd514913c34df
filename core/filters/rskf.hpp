#pragma once

#include <gyrostat/core/models/model_l.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/numerics/risk.hpp>
#include <gyrostat/core/numerics/scalar_update.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

template <class T>
struct RskfParameters : RandomErrorParameters<T> {
  T mu_x{0.0};
  T mu_x_previous{0.0};

  static constexpr auto fields() {
    using P = RskfParameters;
    return join_fields<P, T>(
        RandomErrorParameters<T>::fields(),
        std::array{
            Field{"mu_x", &P::mu_x, "1/dps²", ranges::non_negative, "risk parameter of x_k"},
            Field{"mu_x_previous", &P::mu_x_previous, "1/dps²", ranges::non_negative,
                  "risk parameter of x_{k-1}"},
        });
  }
};

/// Risk-sensitive Kalman filter with matrix risk on model L (reference [8] of [A]; Speyer, Fan and
/// Banavar 1992): after the time update P <- (P^-1 - 2 diag(mu))^-1, the minimiser of the expected
/// exponential of the error weighted by mu. Where that does not exist the step goes on without it
/// as `risk_breakdown`. mu = 0 is Kf, bit for bit.
template <class T>
class Rskf {
 public:
  using Scalar = T;
  using Parameters = RskfParameters<T>;
  static constexpr std::string_view title = "risk-sensitive Kalman filter on model L";
  static constexpr Needs needs{};
  static constexpr Role role{};
  static constexpr bool packs_trials = true;

  explicit Rskf(const Parameters& p)
      : model_(p), state_(ModelL<T>::initial(p)), mu_(p.mu_x, p.mu_x_previous) {}

  /// Whether the risk update exists; the prediction stands without it otherwise.
  Mask<T> predict() {
    propagate_companion(state_, model_.first);
    state_.covariance(0, 0) += model_.q;
    return inflate_covariance<T, 2>(state_.covariance, mu_);
  }

  /// z in dps, or NaN for a missing sample.
  Step<T> update(const T& z) { return update_first(state_, model_.R, z); }

  Step<T> step(const Sample<T>& sample) {
    const Mask<T> inflated = predict();
    Step<T> step = update(sample.gyro_dps);
    set_status(step.status, !inflated && !broken(step.status), Status::risk_breakdown);
    return step;
  }

  const Gaussian<T, 2>& state() const { return state_; }

 private:
  ModelL<T> model_;
  Gaussian<T, 2> state_;
  Vector<T, 2> mu_;
};

}  // namespace gyrostat::filters
