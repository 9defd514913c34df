#include <gyrostat/diagnosis/likelihood/noise_about_level.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <gyrostat/diagnosis/likelihood/autoregression.hpp>

namespace gyrostat::gap {
namespace {

/// Of a one-sided density at angles, in units of the density times the sampling rate.
std::vector<double> autocovariance(const std::vector<double>& density, const Angles& angles,
                                   std::size_t lags) {
  const std::size_t last = density.size() - 1;
  std::vector<double> found(lags + 1, 0.0);
  for (std::size_t lag = 0; lag < found.size(); ++lag)
    for (std::size_t k = 0; k <= last; ++k)
      found[lag] += (k == 0 || k == last ? 0.5 : 1.0) * density[k] *
                    std::cos(static_cast<double>(lag) * angles.values[k]);
  for (double& value : found) value *= 0.5 / static_cast<double>(last);
  return found;
}

/// The shortest that predicts nearly as well as the longest.
Autoregression short_autoregression(std::vector<double> covariance) {
  constexpr double nearly = 1.001;
  const auto& errors = autoregression(covariance).errors;
  const auto enough = std::find_if(errors.begin(), errors.end(),
                                   [&](double e) { return e < nearly * errors.back(); });
  covariance.resize(static_cast<std::size_t>(enough - errors.begin()) + 1);
  return autoregression(covariance);
}

}  // namespace

NoiseAboutLevel noise_about_level(NoiseLaw law, const Angles& angles, double cluster_s) {
  constexpr std::size_t longest = 32;
  law = law.without_jumps();
  law.rounding = 0.0;
  const double step_of_walk = law.interval_s * std::exchange(law.walk, 0.0);
  std::vector<Decaying> slow;
  std::erase_if(law.decaying, [&](const Decaying& d) {
    if (d.memory_s < 0.5 * cluster_s) return false;
    slow.push_back(d);
    return true;
  });
  auto density = density_of(law, angles);
  for (double& value : density) value /= law.interval_s;
  const auto fitted = short_autoregression(autocovariance(density, angles, longest));
  NoiseAboutLevel found{.coefficients = fitted.coefficients,
                        .innovation = fitted.errors.back(),
                        .walk = step_of_walk};
  const double sum = std::accumulate(fitted.coefficients.begin(), fitted.coefficients.end(), 1.0);
  const double at_rest = found.innovation / (sum * sum);
  const auto slow_density = [&](double angle) {
    const double chord = 2.0 - 2.0 * std::cos(angle);
    double all = step_of_walk / chord;
    for (const auto& d : slow) {
      const double decay = std::exp(-law.interval_s / d.memory_s);
      all += d.variance * (1.0 - decay * decay) / ((1.0 - decay) * (1.0 - decay) + decay * chord);
    }
    return all;
  };
  constexpr double finest = 1e-6, step = 1.05;
  for (double angle = std::numbers::pi; angle > finest; angle /= step)
    if (slow_density(angle) > at_rest) {
      found.walk = at_rest * (2.0 - 2.0 * std::cos(angle));
      break;
    }
  return found;
}

}  // namespace gyrostat::gap
