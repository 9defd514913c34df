#pragma once

#include <array>
#include <memory>
#include <vector>

#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>

namespace gyrostat::gap {

/// The rate error of a recording reduced to what its likelihood is made of: cluster means for what
/// is slow, a part each, and an averaged periodogram of the train part for what is fast.
class ReducedRate {
 public:
  /// `error_dps` is the gyro less the reference rate and whatever else is known, a value a sample.
  /// Means of clusters have `of_means_dps` besides, a value each, or nothing.
  ReducedRate(const Conditions& conditions, std::vector<double> error_dps,
              std::shared_ptr<const RateGrid> grid, const std::vector<double>& of_means_dps = {});

  struct Slow {
    std::vector<std::size_t> points;  ///< clusters, rising
    Eigen::VectorXd means;
  };
  const Slow& slow(Part part) const { return slow_[index_of(part)]; }
  /// One-sided, dps²/Hz, of segments of 2 (bins - 1) samples.
  const std::vector<double>& periodogram() const { return periodogram_; }
  /// How many independent periodograms it is the mean of.
  double degrees() const { return degrees_; }
  /// Of white noise that is as strong as all that is fast, or, without periodograms, as the means'
  /// differences.
  double white_std_dps() const;
  /// Variance of white noise in a mean over what the grid makes of a cluster's.
  double noise_of_means() const { return noise_of_means_; }
  const RateGrid& grid() const { return *grid_; }
  double cluster_s() const { return cluster_s_; }
  bool is_beside_motion() const { return is_beside_motion_; }

 private:
  void reduce_fast(const Conditions& conditions, const std::vector<double>& error_dps);

  std::shared_ptr<const RateGrid> grid_;
  std::array<Slow, 2> slow_;
  std::vector<double> periodogram_;
  double degrees_ = 0.0, noise_of_means_ = 1.0, cluster_s_;
  bool is_beside_motion_;
};

}  // namespace gyrostat::gap
