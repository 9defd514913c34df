#include <gyrostat/diagnosis/likelihood/line_within.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>

namespace gyrostat::gap {
namespace {

/// Amplitude and phase at the first sample, of `count` values that are not 0.
std::complex<double> line_at(const std::vector<double>& values, double count,
                             double cycles_per_sample) {
  const double turn = -2.0 * std::numbers::pi * cycles_per_sample;
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != 0.0) sum += values[i] * std::polar(1.0, turn * static_cast<double>(i));
  return 2.0 * sum / count;
}

}  // namespace

std::optional<LineWithin> line_within(const Conditions& conditions,
                                      const std::vector<double>& left_dps, const Resonance& band) {
  const auto train = train_about_means(conditions, left_dps);
  const auto count = static_cast<double>(
      std::count_if(train.begin(), train.end(), [](double value) { return value != 0.0; }));
  if (count == 0.0) return std::nullopt;
  std::vector<double> padded = train;
  padded.resize(std::bit_ceil(2 * padded.size()), 0.0);
  const double interval_s = conditions.interval_s();
  const double bin_hz = 1.0 / (interval_s * static_cast<double>(padded.size()));
  // Bins that one resolved frequency takes.
  const auto resolved =
      static_cast<std::size_t>(std::ceil(static_cast<double>(padded.size()) / count));
  constexpr double bands = 1.5, of_band = 0.125;
  constexpr std::size_t beside = 2, fewest = 4, most = 64;
  const auto reach =
      std::min(most, static_cast<std::size_t>(of_band * band.bandwidth_hz /
                                              (bin_hz * static_cast<double>(resolved))));
  if (reach < fewest) return std::nullopt;
  const std::size_t margin = (beside + reach) * resolved;
  if (2 * (margin + 1) >= padded.size()) return std::nullopt;
  const double lowest = (band.centre_hz - bands * band.bandwidth_hz) / bin_hz;
  const double highest = (band.centre_hz + bands * band.bandwidth_hz) / bin_hz;
  const auto first = static_cast<std::size_t>(std::max(lowest, static_cast<double>(margin + 1)));
  const auto last = static_cast<std::size_t>(
      std::min(highest, static_cast<double>(padded.size() / 2 - margin - 1)));
  if (first >= last) return std::nullopt;
  const auto powers = powers_of(padded, first - margin, last + margin);
  const auto n = static_cast<double>(2 * reach);
  double rarest = 0.0, frequency_hz = 0.0;
  for (std::size_t k = margin; k + margin < powers.size(); ++k) {
    double around = 0.0;
    for (std::size_t j = beside + 1; j <= beside + reach; ++j)
      around += powers[k - j * resolved] + powers[k + j * resolved];
    const double rarity = n * std::log1p(powers[k] / around);
    if (!(rarity > rarest)) continue;
    rarest = rarity;
    frequency_hz = static_cast<double>(first - margin + k) * bin_hz;
  }
  const auto line = line_at(train, count, frequency_hz * interval_s);
  const double phase_deg = (std::arg(line) + 0.5 * std::numbers::pi) * 180.0 / std::numbers::pi;
  return LineWithin{{std::abs(line), frequency_hz, wrap_degrees(phase_deg)}, rarest};
}

}  // namespace gyrostat::gap
