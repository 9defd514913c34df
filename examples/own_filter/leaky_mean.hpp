#pragma once

#include <array>
#include <string_view>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/step.hpp>

namespace own {

template <class T>
struct LeakyMeanParameters {
  T time_constant{T(50.0)};

  static constexpr auto fields() {
    using P = LeakyMeanParameters;
    return std::array{
        gyrostat::Field{"time_constant", &P::time_constant, "samples",
                        gyrostat::ranges::at_least_one, "memory of the mean"},
    };
  }
};

/// Takes the mean of the last samples for the gyro's error: all that a gyro at rest needs.
///
/// Templated on its scalar, as every filter: gyrostat runs it on double.
template <class T>
class LeakyMean {
 public:
  using Scalar = T;
  using Parameters = LeakyMeanParameters<T>;
  static constexpr std::string_view title = "leaky mean";
  static constexpr gyrostat::Needs needs{};
  static constexpr gyrostat::Role role{};

  explicit LeakyMean(const Parameters& p) : gain_(T(1.0) / p.time_constant) {}

  gyrostat::Step<T> step(const gyrostat::Sample<T>& sample) {
    if (gyrostat::is_missing(sample.gyro_dps))
      return {.estimate_dps = mean_, .status = gyrostat::Status::no_measurement};
    const T innovation = sample.gyro_dps - mean_;
    mean_ += gain_ * innovation;
    return {.estimate_dps = mean_, .innovation_dps = innovation};
  }

 private:
  T gain_;
  T mean_{T(0.0)};
};

}  // namespace own
