#pragma once

#include <array>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// The rate error of a recording reduced to what its likelihood is made of, a part each: cluster
/// means for what is slow, averaged periodograms for what is fast.
class ReducedRate {
 public:
  /// `error_dps` is the gyro less the reference rate and whatever else is known, a value a sample.
  /// Samples that are `masked` (one flag a sample) do not count.
  ReducedRate(const Conditions& conditions, const std::vector<double>& error_dps,
              const std::vector<char>& masked);

  struct Slow {
    std::vector<std::size_t> points;  ///< clusters, rising
    Eigen::VectorXd means;
  };
  const Slow& slow(Part part) const { return slow_[index_of(part)]; }
  /// One-sided, dps²/Hz, of segments of 2 (bins - 1) samples.
  const std::vector<double>& periodogram(Part part) const { return periodogram_[index_of(part)]; }
  /// How many independent periodograms it is the mean of.
  double degrees(Part part) const { return degrees_[index_of(part)]; }
  /// Of white noise that is as strong as all that is fast, or, without periodograms, as the means'
  /// differences.
  double white_std_dps() const;
  /// Share of the samples that count.
  double kept() const { return kept_; }
  /// Variance of white noise in a mean over that in a mean of all samples of its cluster.
  double noise_of_means() const { return noise_of_means_; }
  /// What periodograms show of a density: samples that do not count are zeros.
  std::vector<double> shown(const std::vector<double>& density) const;

  double cluster_s() const { return cluster_s_; }
  std::size_t first_fast_bin() const { return first_fast_bin_; }
  double resolution_hz() const { return resolution_hz_; }
  const std::vector<double>& angles() const { return angles_; }
  const std::vector<double>& cosines() const { return cosines_; }
  /// Share of a density at each bin, times the resolution, that the variance of a cluster mean is.
  const std::vector<double>& of_a_mean() const { return of_a_mean_; }

 private:
  void reduce_fast(const Conditions& conditions, const std::vector<double>& error_dps,
                   const std::vector<char>& masked);

  std::array<Slow, 2> slow_;
  std::array<std::vector<double>, 2> periodogram_;
  std::array<double, 2> degrees_{};
  double kept_ = 1.0, noise_of_means_ = 1.0, resolution_hz_ = 0.0, cluster_s_ = 0.0;
  std::size_t first_fast_bin_ = 1;
  std::vector<double> angles_, cosines_, of_a_mean_;
  std::vector<double>
      pairs_;  ///< share of pairs of samples at each lag that both count; empty: all
};

}  // namespace gyrostat::gap
