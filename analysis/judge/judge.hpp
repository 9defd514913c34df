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
/// Each statistic is a loop of its own over the stretch, whose sums stay in registers.
template <class T>
class Judge {
  static constexpr int lanes = Lanes<T>::count;

 public:
  void add(const JudgedSteps& steps) {
    const auto at = [](const double* channel, std::size_t k) {
      return Lanes<T>::load(channel + k * lanes);
    };
    T errors[JudgedSteps::most];
    T sum(0.0);
    for (std::size_t k = 0; k < steps.samples; ++k) {
      errors[k] = at(steps.gyro_dps, k) - at(steps.estimate_dps, k);
      if (steps.true_rate_dps != nullptr) errors[k] = errors[k] - at(steps.true_rate_dps, k);
      sum += errors[k];
    }
    rate_.add(errors, steps.samples, sum);
    heading_.add(errors, steps.t_s, steps.samples, any(is_missing(sum)));
    if (steps.has_truth()) {
      sum = T(0.0);
      for (std::size_t k = 0; k < steps.samples; ++k) {
        errors[k] =
            at(steps.estimate_dps, k) - at(steps.true_drift_dps, k) - at(steps.random_error_dps, k);
        sum += errors[k];
      }
      bias_.add(errors, steps.samples, sum);
      covariance_.add(errors, steps.estimate_variance, steps.samples);
    }
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
