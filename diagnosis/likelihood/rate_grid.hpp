#pragma once

#include <array>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

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

  const std::vector<char>& masked() const { return masked_; }
  /// Share of the train part's samples that count.
  double kept() const { return kept_; }
  bool hides_any() const { return hides_any_; }
  /// Samples of a periodogram's segment.
  std::size_t segment() const { return 2 * (angles_.values.size() - 1); }
  const Angles& angles() const { return angles_; }
  double resolution_hz() const { return resolution_hz_; }
  /// Bins up to half the rate of the samples that count where the others come evenly, else all:
  /// above them is what is below, once more.
  std::size_t bins_of_its_own() const {
    const std::size_t bins = angles_.values.size();
    return comes_evenly_ ? 1 + static_cast<std::size_t>(kept_ * static_cast<double>(bins - 1))
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
  bool comes_evenly() const { return comes_evenly_; }
  /// Whether this sample, which does not count, is taken to be halfway between its neighbours, as
  /// those are that stand alone and do not come evenly. The others are zeros: of noise that changes
  /// little from sample to sample, they spread what is slow over all frequencies.
  bool is_halfway(std::size_t sample) const { return !halfway_.empty() && halfway_[sample] != 0; }
  /// What periodograms show of a density: samples that do not count are zeros or halfway, others
  /// have the level taken out.
  std::vector<double> shown(const std::vector<double>& density) const;

 private:
  std::vector<char> masked_;
  Angles angles_;
  bool hides_any_;
  double kept_ = 1.0, resolution_hz_;
  std::size_t first_fast_bin_;
  /// Share of a density at each bin, times the resolution, that the variance of a mean is.
  std::vector<double> of_a_mean_;
  std::array<std::vector<double>, 2> of_neighbours_;  ///< the same of their covariances
  /// The covariance whose density is given, of the samples that count.
  std::vector<double> masked_density(std::vector<double> density) const;
  void put_halfway(const Conditions& conditions);

  std::vector<double>
      pairs_;  ///< share of pairs of samples at each lag that both count; empty: all
  std::vector<char> halfway_;           ///< a flag a sample; empty: none
  std::vector<double> beside_halfway_;  ///< share of pairs of one that counts and one halfway
  std::vector<double> both_halfway_;
  /// Where hidden samples come evenly, what is slow shows elsewhere, too.
  bool comes_evenly_ = false;
  std::vector<double> left_of_level_;  ///< share of a density that subtracting the level leaves
  std::vector<double> seen_of_level_;  ///< through a periodogram's window
};

}  // namespace gyrostat::gap
