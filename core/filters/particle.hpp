#pragma once

#include <cmath>
#include <tuple>

#include <gyrostat/core/models/particle_cloud.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

/// Bootstrap particle filter (Gordon, Salmond and Smith 1993; reference [4] of [A]) on model NL,
/// with systematic resampling. Unlike sigma points its particles do learn the size of the noise, of
/// which only delta1^2 + delta2^2 shows.
///
/// Where no particle gives z a likelihood above zero (z beyond 38 deviations from all) normalising
/// would be 0 / 0: the measurement is left out as `not_finite`, once as an outlier; the second time
/// in succession the cloud is moved to z. Needs R > 0. The kernel runs on any ordered scalar, but
/// what it draws and resamples has no derivative.
template <class T>
class Particle {
 public:
  using Scalar = T;
  using Parameters = ParticleParameters<T>;
  static constexpr std::string_view title = "bootstrap particle filter on model NL";
  static constexpr Needs needs{};
  static constexpr Role role{};
  static constexpr bool draws_noise = true;  ///< so no mirror image, nor exactly zero for nothing

  explicit Particle(const Parameters& p) : noise_std_(p.measurement_noise_std_dps), cloud_(p) {}

  void predict() { cloud_.advance(); }

  /// z in dps, or NaN for a missing sample.
  Step<T> update(const T& z) {
    using std::isfinite;
    const auto [mean, variance] = cloud_.moments(0);
    Step<T> step{.estimate_dps = mean, .estimate_variance = variance};
    if (is_missing(z)) {
      step.status = Status::no_measurement;
      return step;
    }
    const bool weighed = isfinite(z) && cloud_.weigh(z, noise_std_ * noise_std_);
    if (!weighed) {
      step.status = Status::not_finite;
      if (isfinite(z)) lose(z);
      return step;
    }
    lost_ = false;
    step.innovation_dps = z - mean;
    step.innovation_variance = variance + noise_std_ * noise_std_;
    std::tie(step.estimate_dps, step.estimate_variance) = cloud_.moments(0);
    cloud_.refresh();
    return step;
  }

  Step<T> step(const Sample<T>& sample) {
    predict();
    return update(sample.gyro_dps);
  }

  /// Weighted mean and variance of state `i` of [x_k, x_{k-1}, phi, delta1, delta2].
  std::pair<T, T> moments(int i) const { return cloud_.moments(i); }

  LearnedParameters learned() const requires std::same_as<T, double> {
    const auto [phi, variance] = moments(2);
    return {phi, std::sqrt(variance), moments(3).first, moments(4).first};
  }

 private:
  void lose(const T& z) {
    if (lost_) cloud_.move(z - cloud_.moments(0).first, noise_std_);
    lost_ = !lost_;
  }

  T noise_std_;
  ParticleCloud<T> cloud_;
  bool lost_ = false;
};

}  // namespace gyrostat::filters
