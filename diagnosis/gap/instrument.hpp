#pragma once

#include <string_view>
#include <vector>

#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/diagnosis/gap/lens_type.hpp>
#include <gyrostat/diagnosis/gap/scene.hpp>

namespace gyrostat::gap {

/// Where the readings of one lens stand among all.
struct LensView {
  std::string_view id, title, channel, coordinate, unit;
  double least_spread;
  Eigen::Index first, count;
};

/// Every lens that a part of a recording bears, read at once into one vector.
class Instrument {
 public:
  Instrument(const Conditions& conditions, Part part);

  const std::vector<LensView>& lenses() const { return views_; }
  const std::vector<Interval>& at() const { return at_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(at_.size()); }

  /// Every reading; or those of one channel ("gyro_dps", "heading_deg") into `readings`.
  Eigen::VectorXd read(const Scene& scene) const;
  void read(const Scene& scene, std::string_view channel, Eigen::VectorXd& readings) const;

 private:
  std::vector<std::pair<const LensType*, std::any>> lenses_;
  std::vector<LensView> views_;
  std::vector<Interval> at_;
};

}  // namespace gyrostat::gap
