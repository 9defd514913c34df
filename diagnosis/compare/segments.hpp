#pragma once

#include <memory>
#include <span>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/gap/instrument.hpp>

namespace gyrostat::gap {

/// Reads equally long stretches of rate errors by every lens that looks at a gyro alone. Nothing is
/// assumed of what made them.
class SegmentReader {
 public:
  SegmentReader(double rate_hz, std::size_t samples);

  std::size_t samples() const { return samples_; }
  const Instrument& instrument() const { return *instrument_; }
  /// Of as many samples, none of them missing.
  Eigen::VectorXd read(std::span<const double> error_dps) const;

 private:
  std::size_t samples_;
  std::unique_ptr<const Conditions> conditions_;
  std::unique_ptr<const Instrument> instrument_;
};

/// Samples of a block without the clusters at its ends, which may belong to another part.
std::size_t longest_segment(const Conditions& conditions);

/// The stretches of `samples` values that lie within the parts of a trace which Conditions calls
/// `part`, one behind the other. Short gaps are bridged by straight lines; a stretch with more than
/// one value in fifty missing is left out.
std::vector<std::vector<double>> segments_of(const Conditions& conditions,
                                             const std::vector<double>& error_dps, Part part,
                                             std::size_t samples);

}  // namespace gyrostat::gap
