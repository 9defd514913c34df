#pragma once

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/judge/covariance.hpp>
#include <gyrostat/analysis/judge/heading.hpp>
#include <gyrostat/analysis/judge/judged_steps.hpp>
#include <gyrostat/analysis/judge/moments.hpp>
#include <gyrostat/analysis/judge/statuses.hpp>
#include <gyrostat/analysis/judge/whiteness.hpp>

namespace gyrostat::judge {

/// Everything that metrics read of a track, from its steps as they come, on as many trials side by
/// side as T holds: one pass, stretch by stretch. A lane has the bits that it would have alone.
/// A loop over the stretch adds up a few sums that stay in registers: what they wait for is their
/// own last addition, so that one sum alone would take as long.
template <class T>
class Judge {
  static constexpr int lanes = Lanes<T>::count;

 public:
  void add(const JudgedSteps& steps) {
    const auto at = [](const double* channel, std::size_t k) {
      return Lanes<T>::load(channel + k * lanes);
    };
    T rate[JudgedSteps::most], bias[JudgedSteps::most];
    T rates(0.0), biases(0.0);
    for (std::size_t k = 0; k < steps.samples; ++k) {
      const T estimate = at(steps.estimate_dps, k);
      rate[k] = at(steps.gyro_dps, k) - estimate;
      if (steps.true_rate_dps != nullptr) rate[k] = rate[k] - at(steps.true_rate_dps, k);
      rates += rate[k];
      if (!steps.has_truth()) continue;
      bias[k] = estimate - at(steps.true_drift_dps, k) - at(steps.random_error_dps, k);
      biases += bias[k];
    }
    if (steps.has_truth()) {
      Moments<T>::add(rate_, rate, rates, bias_, bias, biases, steps.samples);
      covariance_.add(bias, steps.estimate_variance, steps.samples);
    } else {
      rate_.add(rate, steps.samples, rates);
    }
    heading_.add(rate, steps.t_s, steps.samples, any(is_missing(rates)));
    innovations_.add(steps.innovation_dps, steps.innovation_variance, steps.samples);
    statuses_.add(steps.status, steps.t_s, steps.samples);
  }

  /// All but what a filter learnt.
  void finish(int lane, TrackErrors& errors) const {
    errors.rate = rate_.of_lane(lane);
    errors.bias = bias_.of_lane(lane);
    errors.innovations = innovations_.of_lane(lane);
    errors.covariance = covariance_.of_lane(lane);
    errors.heading = heading_.of_lane(lane);
    errors.steps = statuses_.steps_of_lane(lane);
    errors.first_breakdown_s = statuses_.first_breakdown_s(lane);
  }

 private:
  Moments<T> rate_, bias_;
  Heading<T> heading_;
  Covariance<T> covariance_;
  Whiteness<T> innovations_;
  Statuses<T> statuses_;
};

}  // namespace gyrostat::judge
