#include <gyrostat/diagnosis/starts/spectral_peak.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>

#include <unsupported/Eigen/FFT>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {

SpectralPeak highest_peak(const Spectrum& spectrum, std::size_t widest) {
  SpectralPeak best;
  const auto& s = spectrum.density;
  if (s.size() < 24) return best;
  for (std::size_t reach : {std::size_t{1}, std::size_t{4}, std::size_t{16}, std::size_t{64}}) {
    if (reach > widest) break;
    for (std::size_t k = 3 + reach; k + reach < s.size();
         k += std::max<std::size_t>(1, reach / 2)) {
      const std::size_t low = k > 6 * reach ? k - 6 * reach : 1;
      const std::size_t high = std::min(s.size(), k + 6 * reach + 1);
      std::vector<double> around;
      double inside = 0.0;
      for (std::size_t j = low; j < high; ++j)
        if (j + reach < k || j > k + reach)
          around.push_back(s[j]);
        else
          inside += s[j];
      const double floor = quantile(around, 0.5);
      const double bins = static_cast<double>(2 * reach + 1);
      const double excess = inside - floor * bins;
      const double significance = excess / (floor * std::sqrt(bins));
      if (significance <= best.excess) continue;
      double centre = 0.0, weight = 0.0;
      for (std::size_t j = k - reach; j <= k + reach; ++j) {
        const double above = std::max(0.0, s[j] - floor);
        centre += above * static_cast<double>(j);
        weight += above;
      }
      best = {spectrum.resolution_hz * (weight > 0.0 ? centre / weight : static_cast<double>(k)),
              excess * spectrum.resolution_hz, spectrum.resolution_hz * bins, significance, floor};
    }
  }
  return best;
}

std::vector<double> train_about_means(const Conditions& conditions,
                                      const std::vector<double>& values) {
  std::vector<double> kept(values.size(), 0.0);
  for (const auto& span : conditions.spans(Part::train)) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(values[i])) sum += values[i], count += 1.0;
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(values[i])) kept[i] = values[i] - sum / count;
  }
  return kept;
}

std::vector<double> powers_of(const std::vector<double>& values, std::size_t first,
                              std::size_t last) {
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double> fft;
  fft.fwd(transform, values);
  std::vector<double> powers;
  for (std::size_t k = first; k < last; ++k) powers.push_back(std::norm(transform[k]));
  return powers;
}

double clearest_line_hz(const std::vector<double>& values, double interval_s, std::size_t around,
                        double lowest_hz) {
  constexpr std::size_t fewest = 64, padding = 4, lowest_periods = 3;
  if (values.size() < fewest) return 0.0;
  std::vector<double> padded(std::bit_ceil(padding * values.size() / 2 + 1), 0.0);
  std::copy(values.begin(), values.end(), padded.begin());
  const double length = static_cast<double>(padded.size()) / static_cast<double>(values.size());
  const double resolution_hz = 1.0 / (interval_s * static_cast<double>(padded.size()));
  const auto first = static_cast<std::size_t>(
      std::max(static_cast<double>(lowest_periods) * length, lowest_hz / resolution_hz));
  const std::size_t bins = padded.size() / 2;
  const auto powers = powers_of(padded, 0, bins);
  const std::size_t block =
      around == 0 ? bins : static_cast<std::size_t>(static_cast<double>(around) * length);
  double best = 0.0, highest = 0.0;
  for (std::size_t from = first; from < bins; from += block) {
    // The last has as many as the others.
    const std::size_t to = std::min(from + block, bins),
                      begin = std::max(first, to - std::min(to, block));
    const std::vector<double> power(powers.begin() + static_cast<std::ptrdiff_t>(begin),
                                    powers.begin() + static_cast<std::ptrdiff_t>(to));
    const auto peak = std::max_element(power.begin(), power.end());
    const auto at = static_cast<std::size_t>(peak - power.begin());
    const double over = around == 0 ? *peak : *peak / std::max(quantile(power, 0.5), 1e-300);
    if (over <= highest) continue;
    highest = over;
    best = static_cast<double>(begin + at) * resolution_hz;
  }
  return best;
}

}  // namespace gyrostat::gap
