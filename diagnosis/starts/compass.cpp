#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/start.hpp>

namespace gyrostat::gap {

using namespace effects;

namespace {

template <class Iron>
Iron iron(const Evidence& e) {
  const auto columns = signatures(e, Trace::heading, {Iron{0.1, 0.0}, Iron{0.1, 90.0}});
  const Eigen::VectorXd found = 0.1 * match(columns, trace_of(e, Trace::heading)).amplitudes;
  return {std::hypot(found[0], found[1]),
          std::atan2(found[1], found[0]) * 180.0 / std::numbers::pi};
}

}  // namespace

std::vector<Start> start(HardIron, const Evidence& e) {
  return with_noise_of(e, iron<HardIron>(e));
}
std::vector<Start> start(SoftIron, const Evidence& e) {
  return with_noise_of(e, iron<SoftIron>(e));
}

std::vector<Start> start(CompassLag, const Evidence& e) {
  return cleaned(e, shaped(e, Trace::heading, CompassLag{}, &CompassLag::time_constant_s,
                           0.5 * e.simulator.conditions().interval_s(), 30.0));
}

std::vector<Start> start(MagneticBursts, const Evidence& e) {
  std::vector<double> sizes;
  const auto& slow = e.scene.slow_heading_deg;
  const auto& conditions = e.simulator.conditions();
  for (const auto& span : conditions.slow_spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(slow[i])) sizes.push_back(slow[i]);
  const double centre = quantile(sizes, 0.5);
  for (double& size : sizes) size = std::abs(size - centre);
  const double limit = 6.0 * quantile(sizes, 0.5) / 0.6744897501960817;
  double hit = 0.0, bursts = 0.0, square = 0.0;
  bool inside = false;
  for (const double size : sizes) {
    if (size > limit) {
      hit += 1.0;
      bursts += inside ? 0.0 : 1.0;
      square += size * size;
    }
    inside = size > limit;
  }
  const double interval_s = conditions.slow_interval_s();
  const double hours = static_cast<double>(sizes.size()) * interval_s / 3600.0;
  if (hit == 0.0)
    return with_noise_of(e, MagneticBursts{5.0 / std::max(hours, 0.1), 20.0, 2.0 * limit});
  return with_noise_of(
      e, MagneticBursts{bursts / hours, std::max(hit * interval_s / bursts, interval_s),
                        std::sqrt(square / hit)});
}

}  // namespace gyrostat::gap
