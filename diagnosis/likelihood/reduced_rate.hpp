#pragma once

#include <array>
#include <memory>
#include <vector>

#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>

namespace gyrostat::gap {

/// The rate error of a recording reduced to what its likelihood is made of, a part each: cluster
/// means for what is slow, averaged periodograms for what is fast.
class ReducedRate {
 public:
  /// `error_dps` is the gyro less the reference rate and whatever else is known, a value a sample.
  ReducedRate(const Conditions& conditions, const std::vector<double>& error_dps,
              std::shared_ptr<const RateGrid> grid);

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
  /// Variance of white noise in a mean over that in a mean of all samples of its cluster.
  double noise_of_means() const { return noise_of_means_; }
  const RateGrid& grid() const { return *grid_; }
  double cluster_s() const { return cluster_s_; }

 private:
  void reduce_fast(const Conditions& conditions, const std::vector<double>& error_dps);

  std::shared_ptr<const RateGrid> grid_;
  std::array<Slow, 2> slow_;
  std::array<std::vector<double>, 2> periodogram_;
  std::array<double, 2> degrees_{};
  double noise_of_means_ = 1.0, cluster_s_;
};

}  // namespace gyrostat::gap
