#include <gyrostat/diagnosis/likelihood/changed_band.hpp>

#include <cmath>
#include <cstddef>

namespace gyrostat::gap {

ChangedBand changed_band(const std::vector<double>& change, double resolution_hz) {
  double added = 0.0, taken = 0.0;
  for (const double c : change) (c > 0.0 ? added : taken) += std::abs(c);
  ChangedBand band{.adds = added >= taken, .from_hz = 0.0, .to_hz = 0.0};
  const double all = band.adds ? added : taken;
  double sum = 0.0;
  for (std::size_t k = 0; k < change.size(); ++k) {
    if ((change[k] > 0.0) != band.adds) continue;
    const double before = sum;
    sum += std::abs(change[k]);
    const double at_hz = resolution_hz * static_cast<double>(k);
    if (before < all / 6.0 && sum >= all / 6.0) band.from_hz = at_hz;
    if (before < all * 5.0 / 6.0 && sum >= all * 5.0 / 6.0) band.to_hz = at_hz;
  }
  return band;
}

}  // namespace gyrostat::gap
