#include <gyrostat/diagnosis/likelihood/block_powers.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

#include <unsupported/Eigen/FFT>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {

std::size_t BlockPowers::told() const {
  std::size_t count = 0;
  for (const auto& span : spans)
    count += static_cast<std::size_t>(std::count_if(
        span.begin(), span.end(), [](const auto& powers) { return !powers.empty(); }));
  return count;
}

double BlockPowers::log_gain_of(const std::vector<double>& other) const {
  double sum = 0.0;
  for (const auto& span : spans)
    for (const auto& powers : span)
      for (std::size_t k = 0; k < powers.size(); ++k)
        sum += powers[k] - powers[k] / other[k] - std::log(other[k]);
  return sum;
}

BlockPowers block_powers(const Conditions& conditions, const std::vector<double>& left_dps,
                         const NoiseLaw& noise, std::size_t length, double centre_hz,
                         double reach_hz) {
  BlockPowers found{.length = length,
                    .resolution_hz = conditions.rate_hz() / static_cast<double>(length),
                    .interval_s = conditions.interval_s() * static_cast<double>(length)};
  const auto bin = [&](double hz) {
    return static_cast<std::size_t>(
        std::clamp(hz / found.resolution_hz, 1.0, static_cast<double>(length / 2 - 1)));
  };
  found.first = bin(centre_hz - reach_hz);
  const std::size_t last = bin(centre_hz + reach_hz) + 1;
  const auto density = density_of(noise, Angles(length / 2 + 1));
  for (std::size_t k = found.first; k < last; ++k)
    found.noise_dps2.push_back(0.5 * density[k] * conditions.rate_hz());

  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> values(length);
  std::vector<std::complex<double>> transform;
  for (const auto& span : conditions.spans(Part::train)) {
    auto& blocks = found.spans.emplace_back();
    for (std::size_t at = span.first; at + length <= span.last; at += length) {
      std::size_t there = 0;
      for (std::size_t i = 0; i < length; ++i) {
        const bool is_there = !is_missing(left_dps[at + i]);
        values[i] = is_there ? left_dps[at + i] : 0.0;
        there += is_there ? 1 : 0;
      }
      auto& powers = blocks.emplace_back();
      if (2 * there < length) continue;
      fft.fwd(transform, values);
      for (std::size_t k = found.first; k < last; ++k)
        powers.push_back(std::norm(transform[k]) /
                         (static_cast<double>(there) * found.noise_dps2[k - found.first]));
    }
  }
  return found;
}

}  // namespace gyrostat::gap
