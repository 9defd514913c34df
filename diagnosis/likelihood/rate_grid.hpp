#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Evenly spaced angles (radians a sample) from 0 to pi, with what densities need of them.
struct Angles {
  /// As many as there are bins of a periodogram, two at least.
  explicit Angles(std::size_t bins);

  std::vector<double> values, cosines, sines;
};

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
  /// Below it cluster means show more.
  std::size_t first_fast_bin() const { return first_fast_bin_; }
  /// Share of a density at each bin, times the resolution, that the variance of a cluster mean is.
  const std::vector<double>& of_a_mean() const { return of_a_mean_; }
  /// What periodograms show of a density: samples that do not count are zeros.
  std::vector<double> shown(const std::vector<double>& density) const;

 private:
  std::vector<char> masked_;
  Angles angles_;
  bool hides_any_;
  double kept_ = 1.0, resolution_hz_;
  std::size_t first_fast_bin_;
  std::vector<double> of_a_mean_;
  std::vector<double>
      pairs_;  ///< share of pairs of samples at each lag that both count; empty: all
};

}  // namespace gyrostat::gap
