#include <gyrostat/diagnosis/likelihood/beside.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gyrostat/diagnosis/likelihood/slow_law.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>

namespace gyrostat::gap {

double Beside::slow_std_dps() const {
  const auto law = slow_law(fitter.reduced(), law_of(fit.scenario, conditions.interval_s()));
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
  if (is_moved) return found;
  const auto slow = slow_lines();
  found.insert(found.end(), slow.begin(), slow.end());
  return found;
}

std::vector<Resonance> Beside::slow_lines() const {
  constexpr std::size_t fewest = 64;
  const auto slow = fitter.terms(fit.scenario).slow;
  const std::size_t count = slow.innovations.size();
  if (count < fewest) return {};
  const auto& points = fitter.reduced().slow(Part::train).points;
  std::vector<double> innovations(points.back() + 1, 0.0);
  double of_one = 0.0;  // variance, dps²
  for (std::size_t k = 0; k < count; ++k) {
    innovations[points[k + 1]] = slow.innovations[k];
    of_one += std::exp(slow.log_variances[k]) / static_cast<double>(count);
  }
  const std::size_t bins = innovations.size() / 2;
  const double interval_s = conditions.slow_interval_s();
  const double resolution_hz = 1.0 / (interval_s * static_cast<double>(innovations.size()));
  auto excess = powers_of(innovations, 0, bins);
  for (double& e : excess) e = e / static_cast<double>(count) - 1.0;
  std::vector<Resonance> found;
  for (std::size_t width = 3; 8 * width < bins; width *= 3) {
    double most = 0.0;
    std::size_t at = 0;
    // One that is narrower than its frequency.
    for (std::size_t k = 2 * width; k + width < bins; ++k) {
      const auto first = excess.begin() + static_cast<std::ptrdiff_t>(k);
      const double sum = std::accumulate(first, first + static_cast<std::ptrdiff_t>(width), 0.0);
      if (sum > most) most = sum, at = k;
    }
    const auto in_bins = static_cast<double>(width);
    // Of few ordinates, the largest of all is an exponential one's.
    if (most < 4.0 * std::sqrt(in_bins) + std::log(static_cast<double>(bins))) continue;
    const double centre_hz = (static_cast<double>(at) + 0.5 * (in_bins - 1.0)) * resolution_hz;
    const double x = std::numbers::pi * centre_hz * interval_s, of_mean = std::sin(x) / x;
    found.push_back({1.3 * most / static_cast<double>(bins) * of_one / (of_mean * of_mean),
                     centre_hz, 0.6 * in_bins * resolution_hz});
  }
  return found;
}

}  // namespace gyrostat::gap
