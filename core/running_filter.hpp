#pragma once

#include <cstddef>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/track.hpp>

namespace gyrostat {

/// What a filter sees of one trial over some samples. Gyro, heading and truth may stand among those
/// of other trials, `stride` apart; null is a channel that is absent.
struct SampleColumns {
  const double* t_s = nullptr;
  const double* temperature_C = nullptr;
  const double* mag_valid = nullptr;
  const double* gyro_dps = nullptr;
  const double* heading_deg = nullptr;
  const double* true_rate_dps = nullptr;
  const double* true_drift_dps = nullptr;
  std::size_t gyro_stride = 1, heading_stride = 1, truth_stride = 1;

  /// Sample `k` as a filter may see it: no heading where the compass is flagged as disturbed.
  Sample<double> at(std::size_t k) const {
    const auto value = [](const double* channel, std::size_t i) {
      return channel == nullptr ? no_value : channel[i];
    };
    const bool disturbed = mag_valid != nullptr && mag_valid[k] != 1.0;
    return {.t_s = t_s[k],
            .gyro_dps = gyro_dps[k * gyro_stride],
            .temperature_C = value(temperature_C, k),
            .heading_deg = disturbed ? no_value : value(heading_deg, k * heading_stride),
            .true_rate_dps = value(true_rate_dps, k * truth_stride),
            .true_drift_dps = value(true_drift_dps, k * truth_stride)};
  }
};

/// A filter under way, without its C++ type: one trial, stretch by stretch.
class RunningFilter {
 public:
  virtual ~RunningFilter() = default;
  /// The next `samples`; the step at sample k goes to [k * stride] of each column.
  virtual void run(const SampleColumns& in, const PackedSteps& out, std::size_t stride,
                   std::size_t samples) = 0;
  virtual LearnedParameters learned() const = 0;
};

template <Filter F>
class RunningOf final : public RunningFilter {
 public:
  explicit RunningOf(const F& filter) : filter_(filter) {}

  void run(const SampleColumns& in, const PackedSteps& out, std::size_t stride,
           std::size_t samples) override {
    for (std::size_t k = 0; k < samples; ++k) {
      const auto step = filter_.step(in.at(k));
      const std::size_t at = k * stride;
      out.estimate_dps[at] = step.estimate_dps;
      out.estimate_variance[at] = step.estimate_variance;
      out.innovation_dps[at] = step.innovation_dps;
      out.innovation_variance[at] = step.innovation_variance;
      out.status[at] = static_cast<double>(step.status);
    }
  }
  LearnedParameters learned() const override { return learned_by(filter_); }

 private:
  F filter_;
};

/// Those of a series from sample `first` on.
SampleColumns columns_of(const Series& series, std::size_t first);

/// All of a series by a filter that is at its start.
void run_to_the_end(RunningFilter& filter, const Series& series, Track& track);

}  // namespace gyrostat
