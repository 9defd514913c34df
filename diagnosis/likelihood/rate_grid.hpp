#pragma once

#include <array>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/counted_samples.hpp>

namespace gyrostat::gap {

/// Evenly spaced angles (radians a sample) from 0 to pi, with what densities need of them.
struct Angles {
  /// As many as there are bins of a periodogram, two at least.
  explicit Angles(std::size_t bins);

  std::vector<double> values, cosines, sines;
};

/// The level beside samples that do not count is the mean of so many clusters.
inline constexpr std::size_t clusters_of_level = 9;

/// At which frequencies a recording's rate error is looked at, and which of its samples count: what
/// all sets of effects that are held against one recording share.
class RateGrid {
 public:
  /// Samples that are `masked` (one flag a sample) do not count.
  RateGrid(const Conditions& conditions, std::vector<char> masked);

  const CountedSamples& counted() const { return counted_; }
  /// Samples of a periodogram's segment.
  std::size_t segment() const { return 2 * (angles_.values.size() - 1); }
  const Angles& angles() const { return angles_; }
  double resolution_hz() const { return resolution_hz_; }
  /// Bins up to half the rate of the samples that count where the others come evenly, else all:
  /// above them is what is below, once more.
  std::size_t bins_of_its_own() const {
    const std::size_t bins = angles_.values.size();
    return counted_.come_evenly()
               ? 1 + static_cast<std::size_t>(counted_.share() * static_cast<double>(bins - 1))
               : bins;
  }
  double nyquist_hz() const { return resolution_hz_ * static_cast<double>(bins_of_its_own() - 1); }
  /// Below it cluster means show more.
  std::size_t first_fast_bin() const { return first_fast_bin_; }
  /// Variance of the mean of a cluster's samples that count, under a density of all; where these do
  /// not come evenly, over what noise that is white has the more of it for being fewer.
  double variance_of_a_mean(const std::vector<double>& density) const;
  /// Covariances of a mean with the next and with the one after it, where all samples count.
  std::array<double, 2> covariances_of_means(const std::vector<double>& density) const;
  /// What periodograms show of a density: samples that do not count are zeros or halfway, others
  /// have the level taken out.
  std::vector<double> shown(const std::vector<double>& density) const;

 private:
  Angles angles_;
  CountedSamples counted_;
  double resolution_hz_;
  std::size_t first_fast_bin_;
  /// Share of a density at each bin, times the resolution, that the variance of a mean is.
  std::vector<double> of_a_mean_;
  std::array<std::vector<double>, 2> of_neighbours_;  ///< the same of their covariances
  // Where hidden samples come evenly:
  std::vector<double> left_of_level_;  ///< share of a density that subtracting the level leaves
  std::vector<double> seen_of_level_;  ///< through a periodogram's window
};

}  // namespace gyrostat::gap
