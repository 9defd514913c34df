#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gyrostat::gap {

/// The variance of rounded noise goes with the cosine of the level, in grids, by the first harmonic
/// of the rounding error (Widrow and Kollar, "Quantization Noise", 2008, 4.3); a law of the size
/// that followed it all would gain n / 4 times its mean square. A law with tails gains n / 48 times
/// the square of the excess kurtosis from normal noise with as little of it (Edgeworth's series);
/// twice that is allowed, at the worst of levels.
SetSearcher::OfGrid SetSearcher::feigned_by_grid(double lsb_of_noise) const {
  constexpr double fine = 0.5;  // where the harmonic is 1e-33
  if (lsb_of_noise < fine) return {};
  const auto n = static_cast<double>(recording_.size());
  const double lsb2 = lsb_of_noise * lsb_of_noise;
  const double before_rounding = std::max(0.0, 1.0 - lsb2 / 12.0);
  constexpr double pi2 = std::numbers::pi * std::numbers::pi;
  const double share =
      (lsb2 / pi2 + 4.0 * before_rounding) * std::exp(-2.0 * pi2 * before_rounding / lsb2);

  const double deviation = std::sqrt(before_rounding) / lsb_of_noise;  // in grids
  const auto below = [&](double value) {
    return 0.5 * std::erfc(-value / (deviation * std::numbers::sqrt2));
  };
  double excess = 0.0;
  for (const double level : {0.0, 0.125, 0.25, 0.375, 0.5}) {
    std::array<double, 5> moments{};
    for (int k = -12; k <= 12; ++k) {
      const double chance = below(k + 0.5 - level) - below(k - 0.5 - level);
      for (std::size_t power = 0; power < moments.size(); ++power)
        moments[power] += chance * std::pow(k, static_cast<double>(power));
    }
    const double mean = moments[1], square = moments[2] - mean * mean;
    const double fourth = moments[4] - 4.0 * mean * moments[3] + 6.0 * mean * mean * moments[2] -
                          3.0 * std::pow(mean, 4);
    excess = std::max(excess, fourth / (square * square) - 3.0);
  }
  return {.warmth = n / 8.0 * share * share, .tails = n / 24.0 * excess * excess};
}

}  // namespace gyrostat::gap
