#include "analysis/gap/instrument.hpp"

namespace gyrostat::gap {

Instrument::Instrument(const Conditions& conditions, Part part) {
  Lenses::for_each([&]<class Entry>(Entry /*entry*/) {
    using Bound = typename Entry::type;
    Bound lens(conditions, part);
    if (lens.at.empty()) return;
    views_.push_back({Entry::id, Bound::title, Bound::channel, Bound::coordinate, Bound::unit,
                      Bound::least_spread, size(), static_cast<Eigen::Index>(lens.at.size())});
    at_.insert(at_.end(), lens.at.begin(), lens.at.end());
    lenses_.emplace_back(std::move(lens));
  });
}

Eigen::VectorXd Instrument::read(const Scene& scene) const {
  Eigen::VectorXd readings(size());
  read(scene, "gyro_dps", readings);
  read(scene, "heading_deg", readings);
  return readings;
}

void Instrument::read(const Scene& scene, std::string_view channel,
                      Eigen::VectorXd& readings) const {
  for (std::size_t k = 0; k < lenses_.size(); ++k)
    if (views_[k].channel == channel)
      std::visit([&](const auto& lens) { lens.read(scene, readings.data() + views_[k].first); },
                 lenses_[k]);
}

}  // namespace gyrostat::gap
