#include <gyrostat/diagnosis/likelihood/law_gain.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gyrostat::gap {
namespace {

/// Where laws are held against each other, and how many ordinates each frequency stands for: below
/// the fast bins of a grid in numbers that grow in proportion, from there on at its bins.
class Ordinates {
 public:
  Ordinates(const RateGrid& grid, double samples, double lost) : grid_(grid) {
    constexpr double finest = 0.03;  // of a frequency
    const double a_bin = samples / static_cast<double>(grid.segment());
    const double fast = (static_cast<double>(grid.first_fast_bin()) - 0.5) * a_bin;
    slow_.values.clear();
    for (double first = std::floor(lost) + 1.0; first < fast;) {
      const double last = std::min(fast, std::max(first + 1.0, std::floor(first * (1.0 + finest))));
      slow_.values.push_back(2.0 * std::numbers::pi * 0.5 * (first + last - 1.0) / samples);
      counts_.push_back(last - first);
      first = last;
    }
    if (slow_.values.size() < 2) {
      slow_.values.clear();
      counts_.clear();
    }
    slow_.cosines.resize(slow_.values.size());
    slow_.sines.resize(slow_.values.size());
    for (std::size_t k = 0; k < slow_.values.size(); ++k) {
      slow_.cosines[k] = std::cos(slow_.values[k]);
      slow_.sines[k] = std::sin(slow_.values[k]);
    }
    counts_.resize(counts_.size() + grid.angles().values.size() - 1 - grid.first_fast_bin(), a_bin);
  }

  const std::vector<double>& counts() const { return counts_; }
  std::vector<double> of(const NoiseLaw& law) const {
    std::vector<double> density;
    if (!slow_.values.empty()) {
      NoiseLaw below = law;
      below.wandering.clear();  // about a fast frequency, as a rule
      density = density_of(below, slow_);
    }
    const auto fast = density_of(law, grid_.angles());
    density.insert(density.end(),
                   fast.begin() + static_cast<std::ptrdiff_t>(grid_.first_fast_bin()),
                   fast.end() - 1);
    return density;
  }

 private:
  const RateGrid& grid_;
  Angles slow_{2};
  std::vector<double> counts_;
};

}  // namespace

Gain gain_over(const NoiseLaw& truth, const NoiseLaw& rival, const RateGrid& grid, double samples,
               double lost) {
  const Ordinates at(grid, samples, lost);
  const auto& counts = at.counts();
  const std::size_t n = counts.size();
  if (n < 2) return {0.0, 0.0};
  NoiseLaw other = rival;
  other.white = other.walk = 0.0;
  const auto seen = at.of(truth), fixed = at.of(other);
  other.white = 1.0;
  auto white = at.of(other);
  other.white = 0.0;
  other.walk = 1.0;
  auto walk = at.of(other);
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
      const double weight = counts[k] / (density[k] * density[k]);
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
    constexpr double damped = 0.5, settled = 1e-7;
    const bool ends = std::abs(to_a - a) <= settled * a && std::abs(to_b - b) <= settled * b;
    a = std::max(1e-6 * a, a + damped * (to_a - a));
    b = b + damped * (to_b - b);
    if (ends) break;
  }
  Gain gain{0.0, 0.0};
  for (std::size_t k = 0; k < n; ++k) {
    const double excess = seen[k] / (fixed[k] + a * white[k] + b * walk[k]) - 1.0;
    gain.mean += counts[k] * (excess - std::log1p(excess));
    gain.deviation += counts[k] * excess * excess;
  }
  gain.deviation = std::sqrt(gain.deviation);
  return gain;
}

}  // namespace gyrostat::gap
