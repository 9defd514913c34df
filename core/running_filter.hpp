#pragma once

#include <cstddef>
#include <optional>

#include <gyrostat/core/held/held_interval.hpp>
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

  /// From sample `k` on.
  SampleColumns from(std::size_t k) const {
    const auto moved = [k](const double* channel, std::size_t stride) {
      return channel == nullptr ? nullptr : channel + k * stride;
    };
    SampleColumns columns = *this;
    for (const double** shared : {&columns.t_s, &columns.temperature_C, &columns.mag_valid})
      *shared = moved(*shared, 1);
    columns.gyro_dps = moved(gyro_dps, gyro_stride);
    columns.heading_deg = moved(heading_deg, heading_stride);
    columns.true_rate_dps = moved(true_rate_dps, truth_stride);
    columns.true_drift_dps = moved(true_drift_dps, truth_stride);
    return columns;
  }

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
  /// Where it stands between two epochs, if it only holds there; the same answer throughout.
  virtual std::optional<HeldInterval<double>> held() const = 0;
  /// After samples that were taken in its stead, none of them an epoch.
  virtual void resume(const HeldInterval<double>& held) = 0;
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

  std::optional<HeldInterval<double>> held() const override {
    if constexpr (requires { filter_.held(); })
      return filter_.held();
    else
      return std::nullopt;
  }
  void resume(const HeldInterval<double>& held) override {
    if constexpr (requires { filter_.resume(held); }) filter_.resume(held);
  }

 private:
  F filter_;
};

/// Those of a series from sample `first` on.
SampleColumns columns_of(const Series& series, std::size_t first);

/// All of a series by a filter that is at its start.
void run_to_the_end(RunningFilter& filter, const Series& series, Track& track);

}  // namespace gyrostat
