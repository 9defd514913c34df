#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gyrostat::gap {
namespace {

/// Density of a unit process with autocovariance a^|k| over that of unit white noise.
double poisson_kernel(double a, double cosine) {
  return (1.0 - a) * (1.0 + a) / (1.0 - 2.0 * a * cosine + a * a);
}

}  // namespace

NoiseLaw NoiseLaw::without_jumps() const {
  NoiseLaw law = *this;
  if (!jumps) return law;
  const double square = jumps->size_dps * jumps->size_dps;
  if (jumps->to == Jumps::To::the_other_level)
    law.decaying.push_back({square, 0.5 / jumps->per_s});
  else
    law.walk += square * jumps->per_s;
  law.jumps.reset();
  return law;
}

std::vector<double> density_of(const NoiseLaw& given, const std::vector<double>& angles,
                               const std::vector<double>& cosines) {
  const NoiseLaw law = given.without_jumps();
  const double step = law.walk * law.interval_s;
  std::vector<double> density(cosines.size(), law.rounding);
  std::vector<double> memories;
  for (const auto& d : law.decaying) memories.push_back(std::exp(-law.interval_s / d.memory_s));
  for (std::size_t k = 0; k < cosines.size(); ++k) {
    const double c = cosines[k];
    double gain = law.filter ? law.filter->gain(angles[k], c, law.interval_s) : 1.0;
    if (!law.averaging.empty()) {
      double averaged = law.averaging[0];
      for (std::size_t lag = 1; lag < law.averaging.size(); ++lag)
        averaged += 2.0 * law.averaging[lag] * std::cos(static_cast<double>(lag) * angles[k]);
      gain *= averaged;
    }
    density[k] += law.white * std::max(gain, 1e-9) + law.angle * (1.0 - c);
    for (std::size_t i = 0; i < memories.size(); ++i)
      density[k] += law.decaying[i].variance * poisson_kernel(memories[i], c);
    density[k] += step / std::max(2.0 - 2.0 * c, 1e-12);
  }
  // Through the window of a periodogram, no line is narrower than a bin.
  const double bin_hz =
      angles.size() > 1 ? (angles[1] - angles[0]) / (2.0 * std::numbers::pi * law.interval_s) : 0.0;
  for (const auto& r : law.resonances) {
    const double bandwidth_hz = std::max(r.bandwidth_hz, bin_hz);
    const double a = std::exp(-std::numbers::pi * bandwidth_hz * law.interval_s);
    const double centre = 2.0 * std::numbers::pi * r.centre_hz * law.interval_s;
    for (std::size_t k = 0; k < angles.size(); ++k)
      density[k] += 0.5 * r.variance *
                    (poisson_kernel(a, std::cos(angles[k] - centre)) +
                     poisson_kernel(a, std::cos(angles[k] + centre)));
  }
  for (double& d : density) d *= 2.0 * law.interval_s;
  return density;
}

}  // namespace gyrostat::gap
