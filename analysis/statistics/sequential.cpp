#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/sequential.hpp>

#include <cmath>
#include <numbers>

#include <boost/math/tools/roots.hpp>

namespace gyrostat {
namespace {

/// The density of the standardised mean where no look has stopped yet, at the nodes of Simpson's
/// rule on [-bound, bound], times their weights.
struct Continuing {
  static constexpr std::size_t nodes = 81;
  double z[nodes], mass[nodes];

  template <class Density>
  Continuing(double bound, const Density& density) {
    const double step = 2.0 * bound / (nodes - 1);
    for (std::size_t i = 0; i < nodes; ++i) {
      const double weight = i == 0 || i == nodes - 1 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      z[i] = -bound + static_cast<double>(i) * step;
      mass[i] = weight * step / 3.0 * density(z[i]);
    }
  }
};

double normal_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

/// Where f, which falls, is zero.
template <class F>
double zero_of(const F& f) {
  boost::uintmax_t steps = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      f, 0.0, 12.0, boost::math::tools::eps_tolerance<double>(40), steps);
  return 0.5 * (low + high);
}

}  // namespace

double normal_tail(double bound) { return 0.5 * std::erfc(bound / std::numbers::sqrt2); }

std::vector<std::uint32_t> look_counts(std::uint32_t first, std::uint32_t last) {
  std::vector<std::uint32_t> counts;
  for (std::uint64_t n = first; n <= last; n *= 2) {
    counts.push_back(static_cast<std::uint32_t>(n));
    const std::uint64_t between = n + (2 * n + 4) / 5;
    if (between < 2 * n && between <= last) counts.push_back(static_cast<std::uint32_t>(between));
  }
  return counts;
}

std::vector<double> sequential_bounds(std::span<const std::uint32_t> counts, double alpha) {
  std::vector<double> bounds;
  if (counts.empty()) return bounds;
  bounds.push_back(normal_upper_quantile(alpha / 4.0));
  Continuing going(bounds[0], normal_density);
  for (std::size_t k = 1; k < counts.size(); ++k) {
    const double spent = alpha / static_cast<double>((k + 1) * (k + 2));
    const double correlation = std::sqrt(static_cast<double>(counts[k - 1]) / counts[k]);
    const double rest = std::sqrt(1.0 - correlation * correlation);
    bounds.push_back(zero_of([&](double bound) {
      double beyond = 0.0;
      for (std::size_t i = 0; i < Continuing::nodes; ++i)
        beyond += going.mass[i] * normal_tail((bound - correlation * going.z[i]) / rest);
      return 2.0 * beyond - spent;
    }));
    going = Continuing(bounds.back(), [&](double z) {
      double density = 0.0;
      for (std::size_t i = 0; i < Continuing::nodes; ++i)
        density += going.mass[i] * normal_density((z - correlation * going.z[i]) / rest) / rest;
      return density;
    });
  }
  return bounds;
}

}  // namespace gyrostat
