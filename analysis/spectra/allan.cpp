#include <gyrostat/analysis/spectra/allan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {
namespace {

/// For the rate to tell its own degrees of freedom, and what kind of noise it is.
constexpr std::size_t enough_clusters = 32;

void require(bool holds, const std::string& place, const std::string& problem) {
  if (!holds) throw InputError(place, problem);
}

void require_clusters(std::size_t n, std::span<const std::size_t> clusters) {
  require(n >= 2, "rate", std::to_string(n) + " samples; at least 2 are needed");
  for (const std::size_t m : clusters)
    require(m >= 1 && m <= n / 2, "clusters",
            std::to_string(m) + " is outside [1, " + std::to_string(n / 2) + "]");
}

/// A cluster stands for its mean where no more of it is missing: the variance of white noise is
/// then at most a quarter too large, and by the missing share on average.
constexpr double least_present = 0.8;

/// Running sum of the rate about its mean, from 0: the phase, in samples times the rate's unit; and
/// how many samples there were, where some are missing.
class Phase {
 public:
  explicit Phase(std::span<const double> rate) : sum_(rate.size() + 1, 0.0) {
    std::size_t present = 0;
    double total = 0.0;
    for (std::size_t i = 0; i < rate.size(); ++i) {
      if (std::isinf(rate[i])) throw InputError("rate[" + std::to_string(i) + "]", "is not finite");
      if (std::isnan(rate[i])) continue;
      total += rate[i];
      ++present;
    }
    require(present >= 2, "rate", std::to_string(present) + " samples; at least 2 are needed");
    const double mean = total / static_cast<double>(present);
    if (present < rate.size()) present_.resize(rate.size() + 1, 0);
    for (std::size_t i = 0; i < rate.size(); ++i) {
      const bool is_there = !std::isnan(rate[i]);
      sum_[i + 1] = is_there ? sum_[i] + (rate[i] - mean) : sum_[i];
      if (!present_.empty()) present_[i + 1] = present_[i] + (is_there ? 1u : 0u);
    }
  }

  bool is_complete() const { return present_.empty(); }
  std::size_t size() const { return sum_.size(); }
  /// Of the m samples from i; NaN where too many are missing.
  double cluster(std::size_t i, std::size_t m) const {
    const double sum = sum_[i + m] - sum_[i];
    if (is_complete()) return sum;
    const auto there = static_cast<double>(present_[i + m] - present_[i]);
    const auto all = static_cast<double>(m);
    return there < least_present * all ? no_value : sum * (all / there);
  }
  /// Difference of the sums over the two clusters of m samples that start at i.
  double haar(std::size_t i, std::size_t m) const {
    if (is_complete()) return haar_of_complete(i, m);
    return cluster(i + m, m) - cluster(i, m);
  }
  /// The same, of a rate without missing samples.
  double haar_of_complete(std::size_t i, std::size_t m) const {
    return sum_[i + 2 * m] - 2.0 * sum_[i + m] + sum_[i];
  }
  const double* from(std::size_t i) const { return sum_.data() + i; }

 private:
  std::vector<double> sum_;
  std::vector<std::uint32_t> present_;
};

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
int power_law_exponent(const Phase& phase, std::size_t m) {
  constexpr std::size_t enough = std::size_t{1} << 17;
  std::vector<double> z;
  z.reserve(std::min(enough, phase.size() / m));
  for (std::size_t i = m; i < phase.size() && z.size() < enough; i += m)
    if (const double sum = phase.cluster(i - m, m); !std::isnan(sum)) z.push_back(sum);
  if (z.size() < 3) return 0;
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

/// A sum over places, and how many of them there are.
struct PlaceSum {
  double sum = 0.0;
  std::size_t count = 0;
};

/// Products of values `lag` apart, of which both are there. Eight sums side by side do not wait for
/// one another; which ones there are hangs on no machine.
PlaceSum products_of(const std::vector<double>& values, std::size_t lag) {
  std::array<double, 8> side{}, there{};
  const std::size_t count = values.size() > lag ? values.size() - lag : 0;
  const double *from = values.data(), *to = from + (values.size() - count);
  const auto add = [&](std::size_t i, std::size_t k) {
    const double product = to[i] * from[i];
    const bool is_there = product == product;
    side[k] += is_there ? product : 0.0;
    there[k] += is_there ? 1.0 : 0.0;
  };
  std::size_t i = 0;
  for (; i + side.size() <= count; i += side.size())
    for (std::size_t k = 0; k < side.size(); ++k) add(i + k, k);
  for (; i < count; ++i) add(i, 0);
  return {std::accumulate(side.begin(), side.end(), 0.0),
          static_cast<std::size_t>(std::accumulate(there.begin(), there.end(), 0.0))};
}

/// The same from the rate itself: the overlapping differences of clusters are a stationary series,
/// and the variance of its mean square is that of a Gaussian one with its own autocovariance, which
/// ends within two clusters for white noise and random walks, whatever their mixture. About eight
/// lags a cluster add up to as much as all.
/// Many products tell a covariance as well as all, so of long series pieces are taken that are
/// spread over it.
double degrees_of_freedom_of(const Phase& phase, std::size_t count, std::size_t m) {
  constexpr std::size_t enough = std::size_t{1} << 16, least_piece = 4096;
  const std::size_t step = std::max<std::size_t>(1, m / 8), lags = 2 * m / step;
  const bool whole = count <= enough;
  // Within a piece of a long series only the differences that are whole steps apart.
  const std::size_t stride = whole ? 1 : step, reach = whole ? 2 * m : lags;
  const std::size_t available = (count + stride - 1) / stride;
  const std::size_t pieces =
      whole ? 1 : std::max<std::size_t>(1, std::min(enough, available) / (least_piece + reach));
  const std::size_t length = std::min(enough, available) / pieces;
  std::vector<double> differences(length), sums(lags + 1, 0.0);
  std::vector<std::size_t> products(lags + 1, 0);
  for (std::size_t p = 0; p < pieces; ++p) {
    const std::size_t first = p * (available / pieces);
    for (std::size_t i = 0; i < length; ++i) differences[i] = phase.haar((first + i) * stride, m);
    for (std::size_t l = 0; l <= lags; ++l) {
      const auto [sum, there] = products_of(differences, l * (whole ? step : 1));
      sums[l] += sum;
      products[l] += there;
    }
  }
  const auto covariance = [&](std::size_t l) {
    const std::size_t lag = l * step;
    if (whole && products[l] == count - lag) return sums[l] / static_cast<double>(count);
    const double share = static_cast<double>(count - lag) / static_cast<double>(count);
    return products[l] == 0 ? 0.0 : share * sums[l] / static_cast<double>(products[l]);
  };
  const double variance = covariance(0);
  double sum = 0.5 * variance * variance;
  for (std::size_t l = 1; l <= lags; ++l) {
    const double share = 1.0 - static_cast<double>(l * step) / static_cast<double>(count);
    sum += share * covariance(l) * covariance(l);
  }
  return static_cast<double>(count) * variance * variance / (2.0 * static_cast<double>(step) * sum);
}

/// Sums side by side, which do not wait for one another; how many hangs on no machine.
using SideBySide = std::array<double, 8>;

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void add_squares(const double* phase, std::size_t m, std::size_t places, SideBySide& sums) {
  const double *middle = phase + m, *end = phase + 2 * m;
  SideBySide side = sums;
  std::size_t i = 0;
  for (; i + side.size() <= places; i += side.size())
    for (std::size_t k = 0; k < side.size(); ++k) {
      const double d = end[i + k] - 2.0 * middle[i + k] + phase[i + k];
      side[k] += d * d;
    }
  for (; i < places; ++i) {
    const double d = end[i] - 2.0 * middle[i] + phase[i];
    side[0] += d * d;
  }
  sums = side;
}

/// Places next to each other share all but two samples of their clusters: of more than a million
/// those a 64th of a cluster apart tell as much.
std::size_t apart(std::size_t places, std::size_t m) {
  constexpr std::size_t many = std::size_t{1} << 20, a_cluster = 64;
  return places <= many ? 1 : std::max<std::size_t>(1, m / a_cluster);
}

/// With how many places were looked at, whether something was there or not.
struct SquaredDifferences {
  SideBySide side{};
  std::size_t count = 0, looked_at = 0;

  double sum() const { return std::accumulate(side.begin(), side.end(), 0.0); }
};

/// Of each cluster size, over all places or many. A stretch of the phase serves all sizes while it
/// is in the cache.
std::vector<SquaredDifferences> squares_of(const Phase& phase,
                                           std::span<const std::size_t> clusters) {
  constexpr std::size_t stretch = 1 << 15;
  const std::size_t n = phase.size() - 1;
  std::vector<SquaredDifferences> all(clusters.size());
  for (std::size_t first = 0; first + 2 <= n; first += stretch)
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      const std::size_t m = clusters[c];
      if (first + 2 * m > n) continue;
      auto& squares = all[c];
      const std::size_t places = n - 2 * m + 1, last = std::min(first + stretch, places);
      const std::size_t step = apart(places, m);
      if (step == 1 && phase.is_complete()) {
        add_squares(phase.from(first), m, last - first, squares.side);
        squares.looked_at += last - first;
        squares.count += last - first;
        continue;
      }
      for (std::size_t i = (first + step - 1) / step * step; i < last; i += step) {
        const double d = phase.haar(i, m);
        if (!std::isnan(d)) {
          squares.side[squares.looked_at % squares.side.size()] += d * d;
          ++squares.count;
        }
        ++squares.looked_at;
      }
    }
  return all;
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
  require_clusters(n, clusters);
  const Phase phase(rate);

  std::vector<AllanPoint> points;
  const auto squares = squares_of(phase, clusters);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const std::size_t m = clusters[c];
    if (squares[c].count == 0) continue;  // gaps leave no pair of clusters
    const auto length = static_cast<double>(m), count = static_cast<double>(squares[c].count);
    const double deviation = std::sqrt(squares[c].sum() / (2.0 * count)) / length;
    const int alpha =
        power_law_exponent(phase, std::min(m, std::max<std::size_t>(1, n / enough_clusters)));
    // Gaps leave as many degrees of freedom as the pairs that are left have among all.
    const double left = count / static_cast<double>(squares[c].looked_at);
    const double power_law_edf = std::max(1.0, left * equivalent_degrees_of_freedom(alpha, n, m));
    const bool is_told = n >= enough_clusters * m && deviation > 0.0;
    const double edf = is_told
                           ? std::max(1.0, left * degrees_of_freedom_of(phase, n - 2 * m + 1, m))
                           : power_law_edf;
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
  require_clusters(rate.size(), clusters);
  const Phase phase(rate);
  require(phase.is_complete(), "rate",
          "has missing samples; fill the gaps or pass a stretch without one");
  std::vector<double> variances;
  for (const std::size_t m : clusters) {
    std::vector<double> squares;
    for (std::size_t i = 0; i + 2 * m < phase.size(); i += std::max<std::size_t>(1, m / 8))
      squares.push_back(0.5 * std::pow(phase.haar(i, m) / static_cast<double>(m), 2));
    const auto count = static_cast<double>(squares.size());
    double variance = std::accumulate(squares.begin(), squares.end(), 0.0) / count;
    double least = variance;  // of what differs from 0
    for (const double square : squares)
      if (square > 0.0) least = std::min(least, square);
    for (double change = 1.0; change > 1e-9 && variance > 0.0;) {
      double sum = 0.0;
      for (const double square : squares) sum += std::min(square / variance, cut);
      const double factor = sum / count / expected;
      variance *= factor;
      change = std::abs(factor - 1.0);
      // All that differs from 0 is cut, and too rare to hold the variance up: it falls for ever.
      if (factor < 1.0 && variance * cut < least) variance = 0.0;
    }
    variances.push_back(variance);
  }
  return variances;
}

}  // namespace gyrostat
