#include <gyrostat/diagnosis/likelihood/beside.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat::gap {

double Beside::slow_std_dps() const {
  const auto law = slow_law(fitter.reduced(), law_of(fit.scenario, conditions.interval_s()),
                            conditions.cluster());
  // Beside a walk that is larger the white noise of means may be less than none.
  return std::sqrt(std::max(law.white, law.walk));
}

std::vector<double> Beside::memories_s() const {
  std::vector<double> all;
  const double longest = conditions.interval_s() * static_cast<double>(conditions.size()) / 6.0;
  for (double s = 3.0 * conditions.slow_interval_s(); s < longest; s *= 4.0) all.push_back(s);
  if (all.empty()) all.push_back(0.5 * longest);
  return all;
}

double Beside::middle_temperature_C() const {
  const auto& T = conditions.slow_temperature_C();
  const auto [low, high] = std::minmax_element(T.begin(), T.end());
  return 0.5 * (*low + *high);
}

std::vector<Resonance> Beside::lines() const {
  const auto& reduced = fitter.reduced();
  const auto& seen = reduced.periodogram();
  const double degrees = reduced.degrees();
  const auto density = reduced.grid().shown(
      density_of(law_of(fit.scenario, conditions.interval_s()), reduced.grid().angles()));
  std::vector<Resonance> found;
  const std::size_t first = reduced.grid().first_fast_bin();
  const auto last = std::min(seen.size(), reduced.grid().bins_of_its_own());
  for (std::size_t width = 1; first + 4 * width < last; width *= 3) {
    double best = 0.0, variance = 0.0;
    std::size_t at = 0;
    for (std::size_t k = first; k + width < last; ++k) {
      double excess = 0.0, expected = 0.0, power = 0.0;
      for (std::size_t i = k; i < k + width; ++i) {
        excess += seen[i] / density[i] - 1.0;
        expected += 1.0;
        power += (seen[i] - density[i]) * reduced.grid().resolution_hz();
      }
      const double clear = excess * std::sqrt(degrees / expected);
      if (clear > best) best = clear, variance = power, at = k;
    }
    if (best < 4.0 || variance <= 0.0) continue;
    const auto bins = static_cast<double>(width);
    found.push_back(
        {1.3 * variance,
         (static_cast<double>(at) + 0.5 * (bins - 1.0)) * reduced.grid().resolution_hz(),
         0.6 * bins * reduced.grid().resolution_hz()});
  }
  return found;
}

}  // namespace gyrostat::gap
