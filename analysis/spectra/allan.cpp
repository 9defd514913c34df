#include <gyrostat/analysis/spectra/allan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

/// For the rate to tell its own degrees of freedom, and what kind of noise it is.
constexpr std::size_t enough_clusters = 32;

void require(bool holds, const std::string& place, const std::string& problem) {
  if (!holds) throw InputError(place, problem);
}

/// Running sum of the rate about its mean, from 0: the phase, in samples times the rate's unit.
std::vector<double> phase_of(std::span<const double> rate, std::span<const std::size_t> clusters) {
  const std::size_t n = rate.size();
  require(n >= 2, "rate", std::to_string(n) + " samples; at least 2 are needed");
  for (const std::size_t m : clusters)
    require(m >= 1 && m <= n / 2, "clusters",
            std::to_string(m) + " is outside [1, " + std::to_string(n / 2) + "]");
  for (std::size_t i = 0; i < n; ++i)
    require(std::isfinite(rate[i]), "rate[" + std::to_string(i) + "]",
            "is missing or not finite; fill the gap or pass a stretch without one");
  const double mean = std::accumulate(rate.begin(), rate.end(), 0.0) / static_cast<double>(n);
  std::vector<double> phase(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) phase[i + 1] = phase[i] + (rate[i] - mean);
  return phase;
}

/// Difference of the sums over the two clusters of m samples that start at i.
double haar(const std::vector<double>& phase, std::size_t i, std::size_t m) {
  return phase[i + 2 * m] - 2.0 * phase[i + m] + phase[i];
}

double lag1_autocorrelation(const std::vector<double>& z) {
  const double mean = std::accumulate(z.begin(), z.end(), 0.0) / static_cast<double>(z.size());
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    square += (z[i] - mean) * (z[i] - mean);
    if (i > 0) product += (z[i] - mean) * (z[i - 1] - mean);
  }
  return square > 0.0 ? product / square : 0.0;
}

/// Exponent alpha in [-2, 0] of the rate's spectrum f^alpha about 1/(m samples). What looks bluer
/// than white is taken for white: long clusters of a rate that returns to its mean are
/// anticorrelated, yet do not decorrelate within a sample as blue noise would.
int power_law_exponent(const std::vector<double>& phase, std::size_t m) {
  std::vector<double> z;
  for (std::size_t i = m; i < phase.size(); i += m) z.push_back(phase[i] - phase[i - m]);
  int differences = 0;
  const auto half_exponent = [&] {
    const double r1 = lag1_autocorrelation(z);
    return r1 / (1.0 + r1);
  };
  double delta = half_exponent();
  if (delta >= 0.25) {
    std::adjacent_difference(z.begin(), z.end(), z.begin());
    z.erase(z.begin());
    delta = half_exponent();
    differences = 1;
  }
  return std::clamp(-static_cast<int>(std::lround(2.0 * delta)) - 2 * differences, -2, 0);
}

/// Generalised autocovariance of the phase, up to a factor (Greenhall & Riley's s_x with F
/// infinite, as the running sum of a rate is its integral, not averaged over a sample).
double phase_covariance(double t, int alpha) {
  t = std::abs(t);
  if (alpha == 0) return -t;
  if (alpha == -2) return t * t * t;
  return t > 0.0 ? t * t * std::log(t) : 0.0;
}

/// Equivalent degrees of freedom of the overlapping Allan variance (Greenhall & Riley 2003, full
/// sum). More than 64 steps a cluster add nothing, and cost O(m).
double equivalent_degrees_of_freedom(int alpha, std::size_t n, std::size_t m) {
  const std::size_t steps = std::min<std::size_t>(m, 64);
  const auto coefficient = [alpha](double t) {
    return 6.0 * phase_covariance(t, alpha) -
           4.0 * (phase_covariance(t - 1.0, alpha) + phase_covariance(t + 1.0, alpha)) +
           phase_covariance(t - 2.0, alpha) + phase_covariance(t + 2.0, alpha);
  };
  const double variance = coefficient(0.0);
  const std::size_t count = 1 + steps * (n - 2 * m) / m;
  double sum = 1.0;
  for (std::size_t j = 1; j < std::min(count, 3 * steps); ++j) {
    const double correlation =
        coefficient(static_cast<double>(j) / static_cast<double>(steps)) / variance;
    sum += 2.0 * (1.0 - static_cast<double>(j) / static_cast<double>(count)) * correlation *
           correlation;
  }
  return static_cast<double>(count) / sum;
}

/// The same from the rate itself: the overlapping differences of clusters are a stationary series,
/// and the variance of its mean square is that of a Gaussian one with its own autocovariance, which
/// ends within two clusters for white noise and random walks, whatever their mixture. About eight
/// lags a cluster add up to as much as all.
double degrees_of_freedom_of(const std::vector<double>& differences, std::size_t m) {
  const std::size_t count = differences.size(), step = std::max<std::size_t>(1, m / 8);
  const auto covariance = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < count; ++i) sum += differences[i] * differences[i - lag];
    return sum / static_cast<double>(count);
  };
  const double variance = covariance(0);
  double sum = 0.5 * variance * variance;
  for (std::size_t lag = step; lag <= 2 * m; lag += step) {
    const double share = 1.0 - static_cast<double>(lag) / static_cast<double>(count);
    sum += share * covariance(lag) * covariance(lag);
  }
  return static_cast<double>(count) * variance * variance / (2.0 * static_cast<double>(step) * sum);
}

}  // namespace

std::vector<std::size_t> allan_clusters(std::size_t samples) {
  std::vector<std::size_t> clusters;
  const std::size_t quarter = samples / 4;
  const double longest = std::max(1.0, static_cast<double>(quarter));
  for (int k = 0; std::round(std::pow(10.0, k / 8.0)) <= longest; ++k) {
    const auto m = static_cast<std::size_t>(std::lround(std::pow(10.0, k / 8.0)));
    if (clusters.empty() || m != clusters.back()) clusters.push_back(m);
  }
  return clusters;
}

std::vector<AllanPoint> overlapping_allan_deviation(std::span<const double> rate, double rate_hz,
                                                    std::span<const std::size_t> clusters,
                                                    double confidence) {
  require(rate_hz > 0.0, "rate_hz", std::to_string(rate_hz) + " is outside (0, inf)");
  require(confidence > 0.0 && confidence < 1.0, "confidence",
          std::to_string(confidence) + " is outside (0, 1)");
  const std::size_t n = rate.size();
  const auto by_default = clusters.empty() ? allan_clusters(n) : std::vector<std::size_t>{};
  if (clusters.empty()) clusters = by_default;
  const auto phase = phase_of(rate, clusters);

  std::vector<AllanPoint> points;
  for (const std::size_t m : clusters) {
    std::vector<double> differences(n - 2 * m + 1);
    for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = haar(phase, i, m);
    double sum = 0.0;
    for (const double d : differences) sum += d * d;
    const auto length = static_cast<double>(m);
    const double deviation =
        std::sqrt(sum / (2.0 * static_cast<double>(differences.size()))) / length;
    const int alpha =
        power_law_exponent(phase, std::min(m, std::max<std::size_t>(1, n / enough_clusters)));
    const double power_law_edf = equivalent_degrees_of_freedom(alpha, n, m);
    const bool is_told = n >= enough_clusters * m && deviation > 0.0;
    const double edf = is_told ? degrees_of_freedom_of(differences, m) : power_law_edf;
    const auto bound = [&](double probability) {
      return deviation * std::sqrt(edf / chi_squared_quantile(probability, edf));
    };
    points.push_back({length / rate_hz, deviation, bound(0.5 + confidence / 2.0),
                      bound(0.5 - confidence / 2.0), edf, m, power_law_edf});
  }
  return points;
}

std::vector<double> without_spikes(std::span<const double> rate) {
  constexpr std::size_t reach = 4;
  std::vector<double> steps;
  for (std::size_t i = 1; i < rate.size(); ++i)
    if (std::isfinite(rate[i] - rate[i - 1])) steps.push_back(std::abs(rate[i] - rate[i - 1]));
  require(!steps.empty(), "rate", "no two neighbouring samples are present");
  const auto q90 = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 9 / 10);
  std::nth_element(steps.begin(), q90, steps.end());
  const double threshold = 6.0 * *q90 / (1.6448536269514722 * std::sqrt(2.0));

  std::vector<double> clean(rate.begin(), rate.end());
  double median =
      *std::find_if(rate.begin(), rate.end(), [](double y) { return std::isfinite(y); });
  for (std::size_t i = 0; i < rate.size(); ++i) {
    std::array<double, 2 * reach + 1> window{};
    auto end = window.begin();
    for (std::size_t k = i - std::min(i, reach); k < std::min(i + reach + 1, rate.size()); ++k)
      if (std::isfinite(rate[k])) *end++ = rate[k];
    const auto middle = window.begin() + (end - window.begin()) / 2;
    std::nth_element(window.begin(), middle, end);
    if (end != window.begin()) median = *middle;
    const bool spike = threshold > 0.0 && std::abs(rate[i] - median) > threshold;
    if (spike || !std::isfinite(rate[i])) clean[i] = median;
  }
  return clean;
}

std::vector<double> robust_allan_variances(std::span<const double> rate,
                                           std::span<const std::size_t> clusters) {
  constexpr double cut = 16.0;
  const double expected = chi_squared_cdf(cut, 3) + cut * chi_squared_upper_tail(cut, 1);
  const auto phase = phase_of(rate, clusters);
  std::vector<double> variances;
  for (const std::size_t m : clusters) {
    std::vector<double> squares;
    for (std::size_t i = 0; i + 2 * m < phase.size(); i += std::max<std::size_t>(1, m / 8))
      squares.push_back(0.5 * std::pow(haar(phase, i, m) / static_cast<double>(m), 2));
    const auto count = static_cast<double>(squares.size());
    double variance = std::accumulate(squares.begin(), squares.end(), 0.0) / count;
    for (double change = 1.0; change > 1e-9 && variance > 0.0;) {
      double sum = 0.0;
      for (const double square : squares) sum += std::min(square / variance, cut);
      const double factor = sum / count / expected;
      variance *= factor;
      change = std::abs(factor - 1.0);
    }
    variances.push_back(variance);
  }
  return variances;
}

}  // namespace gyrostat
