#include <gyrostat/diagnosis/likelihood/law_gain.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gyrostat::gap {
namespace {

/// Frequencies whose number grows in proportion, and how many ordinates each stands for.
struct Ordinates {
  Angles angles{2};
  std::vector<double> counts;

  Ordinates(double samples, double lost) {
    constexpr double finest = 0.03;  // of a frequency
    angles.values.clear();
    for (double first = std::floor(lost) + 1.0; first < 0.5 * samples;) {
      const double last = std::max(first + 1.0, std::floor(first * (1.0 + finest)));
      angles.values.push_back(2.0 * std::numbers::pi * 0.5 * (first + last - 1.0) / samples);
      counts.push_back(std::min(last, 0.5 * samples) - first);
      first = last;
    }
    angles.cosines.resize(angles.values.size());
    angles.sines.resize(angles.values.size());
    for (std::size_t k = 0; k < angles.values.size(); ++k) {
      angles.cosines[k] = std::cos(angles.values[k]);
      angles.sines[k] = std::sin(angles.values[k]);
    }
  }
};

}  // namespace

Gain gain_over(const NoiseLaw& truth, const NoiseLaw& rival, double samples, double lost) {
  const Ordinates at(samples, lost);
  const std::size_t n = at.counts.size();
  if (n < 2) return {0.0, 0.0};
  NoiseLaw other = rival;
  other.white = other.walk = 0.0;
  const auto seen = density_of(truth, at.angles), fixed = density_of(other, at.angles);
  other.white = 1.0;
  auto white = density_of(other, at.angles);
  other.white = 0.0;
  other.walk = 1.0;
  auto walk = density_of(other, at.angles);
  for (std::size_t k = 0; k < n; ++k) {
    white[k] -= fixed[k];
    walk[k] -= fixed[k];
  }
  double a = rival.white, b = rival.walk;
  std::vector<double> density(n);
  constexpr int passes = 100;
  for (int pass = 0; pass < passes; ++pass) {
    // Fisher scoring: least squares with the weights of the density before.
    double ww = 0.0, wk = 0.0, kk = 0.0, yw = 0.0, yk = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      density[k] = fixed[k] + a * white[k] + b * walk[k];
      const double weight = at.counts[k] / (density[k] * density[k]);
      const double left = seen[k] - fixed[k];
      ww += weight * white[k] * white[k];
      wk += weight * white[k] * walk[k];
      kk += weight * walk[k] * walk[k];
      yw += weight * white[k] * left;
      yk += weight * walk[k] * left;
    }
    const double determinant = ww * kk - wk * wk;
    double to_a = determinant > 0.0 ? (kk * yw - wk * yk) / determinant : yw / ww;
    double to_b = determinant > 0.0 ? (ww * yk - wk * yw) / determinant : 0.0;
    if (to_b < 0.0) {
      to_b = 0.0;
      to_a = yw / ww;
    }
    constexpr double damped = 0.5;
    a = std::max(1e-6 * a, a + damped * (to_a - a));
    b = b + damped * (to_b - b);
  }
  Gain gain{0.0, 0.0};
  for (std::size_t k = 0; k < n; ++k) {
    const double excess = seen[k] / (fixed[k] + a * white[k] + b * walk[k]) - 1.0;
    gain.mean += at.counts[k] * (excess - std::log1p(excess));
    gain.deviation += at.counts[k] * excess * excess;
  }
  gain.deviation = std::sqrt(gain.deviation);
  return gain;
}

}  // namespace gyrostat::gap
