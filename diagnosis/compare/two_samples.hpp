#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gyrostat/diagnosis/gap/instrument.hpp>

namespace gyrostat::gap {

/// Whether two groups of segments have readings of one distribution, by relabelling them (Pitman's
/// permutation test): valid whatever made them, as far as segments are exchangeable. The statistic
/// is the sum over lenses of the sum of squared t values of their readings over the root of their
/// number. `p` is the share of relabellings that reach it, itself among them; `p_adjusted`, a
/// reading each, is family-wise (Westfall and Young 1993, max-T).
struct TwoSamples {
  double p = 1.0;
  Eigen::VectorXd p_adjusted, real, simulated;  ///< and the groups' means
};
TwoSamples two_samples(const Instrument& instrument, const Eigen::MatrixXd& real,
                       const Eigen::MatrixXd& simulated, std::uint64_t seed);

/// How often noise that is larger by a share would be found at this level, by the same test of as
/// many segments: groups drawn at random from all of `plain`, one of them taken from `louder`, the
/// readings of the same segments with that noise.
double power_of_two_samples(const Instrument& instrument, const Eigen::MatrixXd& plain,
                            const Eigen::MatrixXd& louder, Eigen::Index real, double level,
                            std::uint64_t seed);

/// The gap of simulated segments to real ones: root mean square difference of the groups' mean
/// readings, in spreads of a segment's, less what the means' own errors come to; no reading counts
/// for more than ten spreads. The spreads are of the segments before anything is added, so unit
/// and zero do not change with what is.
class SegmentGap {
 public:
  SegmentGap(const Instrument& instrument, const Eigen::MatrixXd& real,
             const Eigen::MatrixXd& simulated);

  double operator()(const Eigen::MatrixXd& simulated) const;
  /// 95 % interval of 1 - gap after / gap before when segments are drawn again, on both sides.
  std::array<double, 2> closed(const Eigen::MatrixXd& after, std::uint64_t seed) const;

 private:
  double of(const Eigen::MatrixXd& real, const Eigen::MatrixXd& simulated) const;

  Eigen::MatrixXd real_, before_;
  Eigen::VectorXd spread_, weight_;
};

}  // namespace gyrostat::gap
