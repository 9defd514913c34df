#pragma once

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::judge {

/// Integral of the rate error, from 0 at the first sample; a missing one adds nothing.
template <class T>
class Heading {
 public:
  /// `missing`: some of the errors are NaN.
  void add(const T* rate_errors_dps, const double* t_s, std::size_t samples, bool missing) {
    T before_s = started_ ? before_s_ : Lanes<T>::load(t_s);
    T end = end_;
    // Of every other sample each: a comparison waits for the one before it.
    T lowest[2] = {lowest_, lowest_}, highest[2] = {highest_, highest_};
    const auto go_on = [&](std::size_t k, T& low, T& high) {
      const T now_s = Lanes<T>::load(t_s + k * Lanes<T>::count);
      const T grown = end + rate_errors_dps[k] * (now_s - before_s);
      end = missing ? select(is_missing(rate_errors_dps[k]), end, grown) : grown;
      low = select(end < low, end, low);
      high = select(high < end, end, high);
      before_s = now_s;
    };
    std::size_t k = started_ ? 0 : 1;
    for (; k + 1 < samples; k += 2) {
      go_on(k, lowest[0], highest[0]);
      go_on(k + 1, lowest[1], highest[1]);
    }
    if (k < samples) go_on(k, lowest[0], highest[0]);
    end_ = end;
    lowest_ = select(lowest[1] < lowest[0], lowest[1], lowest[0]);
    highest_ = select(highest[0] < highest[1], highest[1], highest[0]);
    before_s_ = before_s;
    started_ = true;
  }

  HeadingExcursion of_lane(int lane) const {
    return {Lanes<T>::at(end_, lane), Lanes<T>::at(lowest_, lane), Lanes<T>::at(highest_, lane)};
  }

 private:
  T end_{0.0}, lowest_{0.0}, highest_{0.0}, before_s_{0.0};
  bool started_ = false;
};

}  // namespace gyrostat::judge
