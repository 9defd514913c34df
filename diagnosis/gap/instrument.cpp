#include <gyrostat/diagnosis/gap/instrument.hpp>

namespace gyrostat::gap {

Instrument::Instrument(const Conditions& conditions, Part part) {
  for (const auto& type : lens_types()) {
    auto lens = type.bind(conditions, part);
    const auto& at = type.at(lens);
    if (at.empty()) continue;
    views_.push_back({type.id, type.title, type.channel, type.coordinate, type.unit,
                      type.least_spread, size(), static_cast<Eigen::Index>(at.size())});
    at_.insert(at_.end(), at.begin(), at.end());
    lenses_.emplace_back(&type, std::move(lens));
  }
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
    if (const auto& view = views_[k]; view.channel == channel)
      lenses_[k].first->read(lenses_[k].second, scene,
                             {readings.data() + view.first, static_cast<std::size_t>(view.count)});
}

}  // namespace gyrostat::gap
