#include <gyrostat/analysis/innovations.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace gyrostat {
namespace {

/// Squares of the quantiles of the standard normal at 0.6, 0.7, 0.8 and 0.9.
constexpr double squared_deciles[] = {0.064184754667301572, 0.2749958977284559, 0.70832630080079417,
                                      1.6423744151498172};

std::size_t decile(double z, double squared) {
  std::size_t outward = 0;
  for (const double bound : squared_deciles) outward += squared > bound;
  return z < 0.0 ? 4 - outward : 5 + outward;
}

/// Ljung and Box (Biometrika 65, 1978) about the known mean zero; `z` begins with `lags` zeros.
void correlate(const std::vector<double>& z, Innovations& result) {
  constexpr std::size_t lags = Innovations::lags;
  std::array<double, lags> products{};  // [l]: at lag lags - l
  double squares = 0.0;
  for (std::size_t i = lags; i < z.size(); ++i) {
    squares += z[i] * z[i];
    for (std::size_t l = 0; l < lags; ++l) products[l] += z[i] * z[i - lags + l];
  }
  const double n = static_cast<double>(z.size() - lags);
  if (z.size() <= 2 * lags || !(squares > 0.0)) return;
  result.lag_1 = products[lags - 1] / squares;
  result.ljung_box = 0.0;
  for (std::size_t l = 0; l < lags; ++l) {
    const double correlation = products[l] / squares;
    result.ljung_box +=
        n * (n + 2.0) * correlation * correlation / (n - static_cast<double>(lags - l));
  }
}

}  // namespace

Innovations innovation_statistics(const Track& track) {
  Innovations result;
  std::vector<double> normalised(Innovations::lags, 0.0);
  normalised.reserve(Innovations::lags + track.status.size());
  std::size_t scored = 0;
  double nis = 0.0, log_score = 0.0, last = no_value, logarithm = 0.0, root = 0.0;
  for (std::size_t i = 0; i < track.status.size(); ++i) {
    const double innovation = track.innovation_dps[i], variance = track.innovation_variance[i];
    const double squared = innovation * innovation / variance;
    if (std::isnan(squared)) continue;
    if (variance != last) {
      last = variance;
      logarithm = std::log(2.0 * std::numbers::pi * variance);
      root = std::sqrt(variance);
    }
    ++result.count;
    nis += squared;
    if (const double score = 0.5 * (logarithm + squared); !std::isnan(score)) {
      log_score += score;
      ++scored;
    }
    const double z = innovation / root;
    if (!std::isfinite(z)) continue;
    normalised.push_back(z);
    result.pit[decile(z, squared)] += 1.0;
  }
  const double n = static_cast<double>(normalised.size() - Innovations::lags);
  for (double& share : result.pit) share = n > 0.0 ? share / n : no_value;
  if (result.count > 0) result.nis = nis / static_cast<double>(result.count);
  if (scored > 0) result.log_score = log_score / static_cast<double>(scored);
  correlate(normalised, result);
  return result;
}

}  // namespace gyrostat
