#pragma once

#include <array>

#include <gyrostat/core/numerics/scalar_update.hpp>

namespace gyrostat {

/// The gains that are to come of a Kalman filter of z = x_0 + v on a model that stays the same.
/// They do not depend on what is measured, and once the covariance has settled they come round: it
/// is then, to the bit, what it was one to `longest` steps ago, since its last bits may go on
/// turning. From there on the mean is all that a step has to compute.
template <class T, int N>
class GainCycle {
 public:
  /// Of `model`, with `predict` of a mean and of mean and covariance and with R, from `state` on.
  template <class Model>
  GainCycle(const Model& model, const Gaussian<T, N>& state) {
    Gaussian<T, N> next = state;
    for (auto& turn : turns_) {
      model.predict(next);
      const Vector<T, N> p = next.covariance.col(0);
      const auto step = update_first<T, N>(next, model.R, next.mean(0));
      turn = {p * T(T(1.0) / step.innovation_variance), step.innovation_variance, next.covariance};
      if (any(is_missing(step.innovation_variance)) || !nearly(next, state)) return;
      ++count_;
      if (same(next.covariance, state.covariance)) {
        comes_round_ = true;
        return;
      }
    }
  }

  bool comes_round() const { return comes_round_; }

  /// The next step, as the filter would make it, of the mean alone. False, with nothing changed,
  /// where some lane has no measurement or would not be finite: the cycle is then over.
  template <class Model>
  bool step(const Model& model, Vector<T, N>& of, const T& z, Step<T>& out) {
    const Turn& turn = turns_[at_];
    Vector<T, N> mean = of;
    model.predict(mean);
    out.innovation_dps = z - mean(0);
    mean += turn.gain * out.innovation_dps;
    if (!all(all_finite(mean))) return false;
    of = mean;
    out.innovation_variance = turn.innovation_variance;
    out.estimate_dps = mean(0);
    out.estimate_variance = turn.covariance(0, 0);
    at_ = at_ + 1 == count_ ? 0 : at_ + 1;
    return true;
  }

  /// The covariance after the last step.
  const Matrix<T, N>& covariance() const {
    return turns_[at_ == 0 ? count_ - 1 : at_ - 1].covariance;
  }

 private:
  static constexpr std::size_t longest = 4;

  struct Turn {
    Vector<T, N> gain;
    T innovation_variance;
    Matrix<T, N> covariance;
  };

  static bool same(const Matrix<T, N>& a, const Matrix<T, N>& b) {
    Mask<T> same = true;
    unrolled<N * N>([&]<int i>() { same = same && a(i % N, i / N) == b(i % N, i / N); });
    return all(same);
  }
  /// While it still moves there is no need to look further.
  static bool nearly(const Gaussian<T, N>& a, const Gaussian<T, N>& b) {
    const T &now = a.covariance(0, 0), &before = b.covariance(0, 0);
    const T apart = now - before, most = T(1e-14) * before;
    return all(apart <= most && -apart <= most);
  }

  std::array<Turn, longest> turns_;
  std::size_t count_ = 0, at_ = 0;
  bool comes_round_ = false;
};

}  // namespace gyrostat
