#pragma once

#include <optional>
#include <span>
#include <vector>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/packed/kernels.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

/// What all trials of a scenario have in common where they differ in the noise of gyro and compass
/// alone: times, temperature, rates, drift, the heading before its noise (not wrapped) and
/// mag_valid. None where an effect on them depends on the trial, or one on the gyro does not go
/// sample by sample.
struct SharedConditions {
  Series series;
  std::vector<double> steady_dps;  ///< rate and drift
  std::vector<Effect> on_gyro;     ///< sample by sample, in the order in which they act
};

std::optional<SharedConditions> shared_conditions(const Scenario& scenario);

/// The signals of trials side by side, made stretch by stretch with the bits of `synthesise`.
class SignalInLanes {
 public:
  /// Whether these noises can be drawn side by side: plain ones of one seed.
  static bool can_draw(std::span<const Noise> trials);

  /// `kernel` has as many lanes as there are trials, or more: the last one is made once more. All
  /// arguments outlive it.
  SignalInLanes(const Scenario& scenario, const SharedConditions& conditions,
                std::span<const Noise> trials, const SignalKernel& kernel);

  const Series& conditions() const { return conditions_.series; }
  int lanes() const { return kernel_.lanes; }
  /// Stretches from the first on, in order.
  void gyro(std::size_t first, std::size_t samples, double* gyro_dps, double* random_error_dps);
  void heading(std::size_t first, std::size_t samples, double* heading_deg) const;
  /// A channel of the conditions, the same in every lane.
  void spread(const std::vector<double>& channel, std::size_t first, std::size_t samples,
              double* out) const {
    kernel_.spread(channel.data() + first, samples, out);
  }

 private:
  void apply_effects(std::size_t first, std::size_t samples, double* gyro_dps);

  const SharedConditions& conditions_;
  Series stretch_;  ///< of all lanes, as effects on the gyro see it
  const SignalKernel& kernel_;
  std::vector<std::uint32_t> trials_;
  std::vector<double> first_difference_dps_, state_;
  std::vector<CompassNoise::Disturbance> disturbances_;
  GyroNoise gyro_;
  CompassNoise compass_;
};

}  // namespace gyrostat
