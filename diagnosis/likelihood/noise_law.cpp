#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/analysis/spectra/cosine_sums.hpp>

namespace gyrostat::gap {
namespace {

/// Density of a unit process with autocovariance a^|k| over that of unit white noise.
double poisson_kernel(double a, double cosine) {
  return (1.0 - a) * (1.0 + a) / (1.0 - 2.0 * a * cosine + a * a);
}

/// As a periodogram through Hann's window shows it, over that of unit white noise.
std::vector<double> density_of(const effects::WanderingLine& line, std::size_t bins,
                               double interval_s) {
  const std::size_t length = 2 * (bins - 1);
  // At its angles, a periodogram takes lags for those that are a segment less.
  std::vector<double> covariance(bins, 0.0);
  const auto turn = std::polar(1.0, 2.0 * std::numbers::pi * line.frequency_hz * interval_s);
  std::complex<double> turned = 0.5 * line.amplitude_dps * line.amplitude_dps;
  const auto step = std::polar(1.0, 2.0 * std::numbers::pi / static_cast<double>(length));
  std::complex<double> angle = 1.0;  // of a lag in the segment that goes once round
  constexpr double forgotten = 1e-10;
  for (std::size_t lag = 0; lag < length; ++lag) {
    const double coherence = line.coherence(static_cast<double>(lag) * interval_s);
    if (coherence < forgotten) break;
    // The window's own autocovariance, over that at lag 0.
    const double share = static_cast<double>(lag) / static_cast<double>(length);
    const double of_window =
        (1.0 - share) * (2.0 + angle.real()) / 3.0 + angle.imag() / (2.0 * std::numbers::pi);
    covariance[std::min(lag, length - lag)] += coherence * of_window * turned.real();
    turned *= turn;
    angle *= step;
  }
  covariance.back() *= 2.0;
  auto density = cosine_sums(covariance);
  for (double& d : density) d = std::max(d, 0.0);
  return density;
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

namespace {

void take_parts(const NoiseLaw& law, const Angles& angles, DensityParts& parts) {
  if (parts.gain_of_white.size() != angles.cosines.size() || law.filter != parts.filter ||
      law.averaging != parts.averaging)
    parts.gain_of_white = gain_of_white(law, angles);
  parts.filter = law.filter;
  parts.averaging = law.averaging;
  parts.of_lines.resize(law.wandering.size());
  for (std::size_t l = 0; l < law.wandering.size(); ++l)
    if (l >= parts.lines.size() || law.wandering[l] != parts.lines[l])
      parts.of_lines[l] = density_of(law.wandering[l], angles.cosines.size(), law.interval_s);
  parts.lines = law.wandering;
}

}  // namespace

std::vector<double> density_of(const NoiseLaw& law, const Angles& angles) {
  DensityParts parts;
  return density_of(law, angles, parts);
}

std::vector<double> density_of(const NoiseLaw& given, const Angles& angles, DensityParts& parts) {
  const NoiseLaw law = given.without_jumps();
  take_parts(law, angles, parts);
  const double step = law.walk * law.interval_s;
  const auto& cosines = angles.cosines;
  const std::size_t bins = cosines.size();
  const auto& gain = parts.gain_of_white;
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
  for (const auto& of_line : parts.of_lines)
    for (std::size_t k = 0; k < bins; ++k) density[k] += of_line[k];
  for (double& d : density) d *= 2.0 * law.interval_s;
  return density;
}

}  // namespace gyrostat::gap
