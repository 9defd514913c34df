#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>
#include <gyrostat/generators/effects/noise_bandwidth.hpp>
#include <gyrostat/generators/effects/wandering_line.hpp>

namespace gyrostat::gap {

/// A stationary error whose autocovariance decays exponentially. One whose variance is below 0
/// takes from the one before it.
struct Decaying {
  double variance;  ///< dps²
  double memory_s;
};

/// A narrow-band random error: the real part of a turning Gauss-Markov process.
struct Resonance {
  double variance;  ///< dps²
  double centre_hz, bandwidth_hz;
};

/// An error that is level between the points of a Poisson process.
struct Jumps {
  enum class To { another_level, the_other_level } to;
  double size_dps;  ///< standard deviation of a jump, or half the distance of the two levels
  double per_s;     ///< rate of the jumps
  bool operator==(const Jumps&) const = default;
};

/// What is random in the rate error of a scenario, in closed form: a sum of independent parts, of
/// which each has its own law. An effect of the catalogue says by `enter` what it adds.
struct NoiseLaw {
  double interval_s = 1.0;
  double duration_s = 0.0;
  double white = 0.0;  ///< variance of a sample before the filter, dps²
  double walk = 0.0;   ///< variance that a random walk gains in a second, dps²/s
  std::optional<effects::NoiseBandwidth> filter{};  ///< that white noise has passed
  std::vector<double>
      averaging{};  ///< autocovariance of unit white noise that is averaged, or empty
  std::vector<Decaying> decaying{};
  std::vector<Resonance> resonances{};
  std::vector<effects::WanderingLine> wandering{};
  std::optional<Jumps> jumps{};
  double angle = 0.0;  ///< variance of the rate's part that is a difference of white errors, dps²
  double rounding = 0.0;  ///< variance that is white after the filter, dps²

  /// A Gaussian law with the same covariance: jumps as decaying errors or as a walk.
  NoiseLaw without_jumps() const;
};

/// Of what passes the law's filter and its averaging, as a share of its density.
std::vector<double> gain_of_white(const NoiseLaw& law, const Angles& angles);

/// What of a density takes long, and what it is of.
struct DensityParts {
  std::optional<effects::NoiseBandwidth> filter{};
  std::vector<double> averaging{}, gain_of_white{};
  std::vector<effects::WanderingLine> lines{};
  std::vector<std::vector<double>> of_lines{};
};

/// One-sided density, dps²/Hz, as a periodogram with these bins shows it.
std::vector<double> density_of(const NoiseLaw& law, const Angles& angles);
/// The same; what `parts`, of a law at the same bins and interval, has of it is taken from there.
/// They are then those of this law.
std::vector<double> density_of(const NoiseLaw& law, const Angles& angles, DensityParts& parts);

}  // namespace gyrostat::gap
