#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

template <class T>
struct WindowedMeanParameters {
  T window{T(50.0)};

  static constexpr auto fields() {
    using P = WindowedMeanParameters;
    return std::array{
        Field{"window", &P::window, "samples", ranges::at_least_one, "memory of the mean"},
    };
  }
};

/// The mean of the last samples, each forgotten by and by.
template <class T>
class WindowedMean {
 public:
  using Scalar = T;
  using Parameters = WindowedMeanParameters<T>;
  static constexpr std::string_view title = "windowed mean";
  static constexpr Needs needs{};
  static constexpr Role role{};

  explicit WindowedMean(const Parameters& p) : gain_(T(1.0) / p.window) {}

  Step<T> step(const Sample<T>& sample) {
    if (is_missing(sample.gyro_dps))
      return {.estimate_dps = mean_, .status = Status::no_measurement};
    mean_ += gain_ * (sample.gyro_dps - mean_);
    return {.estimate_dps = mean_};
  }

 private:
  T gain_;
  T mean_{T(0.0)};
};

}  // namespace gyrostat::filters
