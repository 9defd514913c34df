#pragma once

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/judge/judged_steps.hpp>
#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::judge {

/// Bias errors beside the variances stated for them; what misses either is left out.
template <class T>
class Covariance {
 public:
  void add(const T* bias_errors_dps, const double* variances, std::size_t samples) {
    if (all_missing<T>(variances, samples)) return;
    T sum(0.0), last(0.0), within_1 = within_1_, within_3 = within_3_;
    for (std::size_t k = 0; k < samples; ++k) {
      const T squared = beside(bias_errors_dps[k], variances + k * Lanes<T>::count);
      sum += squared;
      within_1 = one_more(squared <= T(1.0), within_1);
      within_3 = one_more(squared <= T(9.0), within_3);
      last = squared;
    }
    if (any(is_missing(sum))) return add_present(bias_errors_dps, variances, samples);
    within_1_ = within_1;
    within_3_ = within_3;
    last_ = last;
    sum_ += sum;
    count_ += T(static_cast<double>(samples));
  }

  StatedCovariance of_lane(int lane) const {
    const auto at = [lane](const T& value) { return Lanes<T>::at(value, lane); };
    const double n = at(count_);
    if (n == 0.0) return {};
    return {at(sum_) / n, at(last_), at(within_1_) / n, at(within_3_) / n};
  }

 private:
  /// A filter that has settled states the same variance again and again.
  const T& inverse(const double* variance) {
    const T now = Lanes<T>::load(variance);
    if (all(now == variance_)) return inverse_;
    variance_ = now;
    return inverse_ = T(1.0) / now;
  }

  T beside(const T& error, const double* variance) { return error * error * inverse(variance); }

  void add_present(const T* bias_errors_dps, const double* variances, std::size_t samples) {
    T sum(0.0);
    for (std::size_t k = 0; k < samples; ++k) {
      const T squared = beside(bias_errors_dps[k], variances + k * Lanes<T>::count);
      const auto present = !is_missing(squared);
      if (!any(present)) continue;
      sum += select(present, squared, T(0.0));
      count_ = one_more(present, count_);
      within_1_ = one_more(squared <= T(1.0), within_1_);
      within_3_ = one_more(squared <= T(9.0), within_3_);
      last_ = select(present, squared, last_);
    }
    sum_ += sum;
  }

  T count_{0.0}, sum_{0.0}, within_1_{0.0}, within_3_{0.0}, last_{no_value};
  T variance_{no_value}, inverse_{no_value};
};

}  // namespace gyrostat::judge
