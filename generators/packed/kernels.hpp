#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/generators/environment/magnetic/compass.hpp>

namespace gyrostat {

/// The noise of the gyros of trials side by side.
struct GyroNoise {
  Arima111<double> model;
  NormalAddress random_error, white_noise;
  const std::uint32_t* trials = nullptr;         ///< one a lane
  const double* first_difference_dps = nullptr;  ///< but for delta1 a_0; one a lane
  /// Level, difference and white noise at the last sample: three times as many as lanes, zeros at
  /// the start.
  double* state = nullptr;
};

/// That of their compasses.
struct CompassNoise {
  struct Disturbance {
    MagneticDisturbance of;
    NormalAddress at;
  };

  double noise_std_deg = 0.0;
  NormalAddress white_noise;
  const std::uint32_t* trials = nullptr;
  std::span<const Disturbance> disturbances{};
};

/// Makes what differs between trials of the same conditions, so many of them at once: samples
/// `first` and on, as many as a stretch holds at most, `first` a multiple of that. Lane l of sample
/// k goes to [k * lanes + l]. The bits are those of add_random_error, add_white_noise and
/// Compass::read.
struct SignalKernel {
  int lanes = 0;
  /// `steady_dps` is rate and drift of each sample.
  void (*gyro)(const GyroNoise& noise, std::size_t first, std::size_t samples,
               const double* steady_dps, double* gyro_dps, double* random_error_dps) = nullptr;
  /// `turned_deg` is the true heading of each sample.
  void (*heading)(const CompassNoise& noise, std::size_t first, std::size_t samples,
                  const double* t_s, const double* turned_deg, double* heading_deg) = nullptr;
  /// The same values in every lane.
  void (*spread)(const double* values, std::size_t samples, double* out) = nullptr;
};

inline constexpr std::size_t signal_stretch = 64;

/// That of the widest instruction set that has one for so many lanes; null where there is none.
const SignalKernel* signal_kernel(int lanes);

}  // namespace gyrostat
