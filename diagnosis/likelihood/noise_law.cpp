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

std::vector<double> gain_of_white(const NoiseLaw& law, const Angles& angles) {
  const auto& cosines = angles.cosines;
  const std::size_t bins = cosines.size();
  std::vector<double> gain(bins, 1.0);
  if (law.filter) law.filter->multiply_gain(angles.values, cosines, law.interval_s, gain);
  if (!law.averaging.empty())
    for (std::size_t k = 0; k < bins; ++k) {
      // cos((lag + 1) x) = 2 cos x cos(lag x) - cos((lag - 1) x)
      double averaged = law.averaging[0], before = 1.0, here = cosines[k];
      for (std::size_t lag = 1; lag < law.averaging.size(); ++lag) {
        averaged += 2.0 * law.averaging[lag] * here;
        const double next = 2.0 * cosines[k] * here - before;
        before = here;
        here = next;
      }
      gain[k] *= std::max(0.0, averaged);
    }
  return gain;
}

std::vector<double> density_of(const NoiseLaw& given, const Angles& angles) {
  const NoiseLaw law = given.without_jumps();
  const double step = law.walk * law.interval_s;
  const auto& cosines = angles.cosines;
  const std::size_t bins = cosines.size();
  const auto gain = gain_of_white(law, angles);
  std::vector<double> density(bins, law.rounding);
  for (std::size_t k = 0; k < bins; ++k) {
    density[k] += law.white * std::max(gain[k], 1e-9) + law.angle * (1.0 - cosines[k]);
    if (step > 0.0) density[k] += step / std::max(2.0 - 2.0 * cosines[k], 1e-12);
  }
  for (const auto& d : law.decaying) {
    const double a = std::exp(-law.interval_s / d.memory_s);
    for (std::size_t k = 0; k < bins; ++k) density[k] += d.variance * poisson_kernel(a, cosines[k]);
  }
  // Through the window of a periodogram, no line is narrower than a bin.
  const double bin_hz =
      (angles.values[1] - angles.values[0]) / (2.0 * std::numbers::pi * law.interval_s);
  for (const auto& r : law.resonances) {
    const double bandwidth_hz = std::max(r.bandwidth_hz, bin_hz);
    const double a = std::exp(-std::numbers::pi * bandwidth_hz * law.interval_s);
    const double centre = 2.0 * std::numbers::pi * r.centre_hz * law.interval_s;
    const double c = std::cos(centre), s = std::sin(centre);
    for (std::size_t k = 0; k < bins; ++k) {
      const double in_phase = cosines[k] * c, across = angles.sines[k] * s;
      density[k] += 0.5 * r.variance *
                    (poisson_kernel(a, in_phase + across) + poisson_kernel(a, in_phase - across));
    }
  }
  for (double& d : density) d *= 2.0 * law.interval_s;
  return density;
}

}  // namespace gyrostat::gap
