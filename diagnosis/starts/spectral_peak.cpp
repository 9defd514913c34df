#include <gyrostat/diagnosis/starts/spectral_peak.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

#include <unsupported/Eigen/FFT>

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

double clearest_line_hz(const std::vector<double>& white, double interval_s) {
  constexpr std::size_t fewest = 64, padding = 4;
  constexpr std::ptrdiff_t lowest_periods = 3;
  if (white.size() < fewest) return 0.0;
  std::vector<double> padded(padding * white.size(), 0.0);
  std::copy(white.begin(), white.end(), padded.begin());
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double> fft;
  fft.fwd(transform, padded);
  const auto best =
      std::max_element(transform.begin() + lowest_periods * static_cast<std::ptrdiff_t>(padding),
                       transform.begin() + static_cast<std::ptrdiff_t>(padded.size() / 2),
                       [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); });
  return static_cast<double>(best - transform.begin()) /
         (interval_s * static_cast<double>(padded.size()));
}

}  // namespace gyrostat::gap
