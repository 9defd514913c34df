#include <gyrostat/diagnosis/likelihood/outlier_mixture.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gyrostat::gap {

double OutlierMixture::log_odds(double square) const {
  const double along = size * std::sqrt(square) / wide;
  return std::log(share / (1.0 - share)) + 0.5 * std::log(narrow / wide) + 0.5 * square / narrow -
         0.5 * (square + size * size) / wide + along + std::log1p(std::exp(-2.0 * along)) -
         std::log(2.0);
}

namespace {

/// With the likelihood gained by both components.
OutlierMixture weighed(OutlierMixture m, const std::vector<double>& squares) {
  const auto n = static_cast<double>(squares.size());
  double mixed = 0.0;
  for (const double s : squares) {
    const double odds = m.log_odds(s);
    mixed += std::max(odds, 0.0) + std::log1p(std::exp(-std::abs(odds))) - 0.5 * s / m.narrow;
  }
  mixed += n * (std::log(1.0 - m.share) - 0.5 * std::log(m.narrow));
  const double all = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
  m.gain = mixed + 0.5 * n * (std::log(all) + 1.0);
  return m;
}

constexpr double settled = 1e-5;

OutlierMixture about_zero(const std::vector<double>& squares, double narrow) {
  const auto n = static_cast<double>(squares.size());
  double wide = 25.0 * narrow, share = 0.003;
  for (int pass = 0; pass < 60; ++pass) {
    const double log_odds = std::log(share / (1.0 - share)) + 0.5 * std::log(narrow / wide);
    const double curve = 0.5 * (1.0 / narrow - 1.0 / wide);
    double weight = 0.0, of_wide = 0.0, of_narrow = 0.0;
    for (const double s : squares) {
      const double hit = 1.0 / (1.0 + std::exp(-(log_odds + curve * s)));
      weight += hit;
      of_wide += hit * s;
      of_narrow += (1.0 - hit) * s;
    }
    const double share_before = std::exchange(share, std::clamp(weight / n, 1e-6, 0.5));
    const double wide_before = wide;
    narrow = of_narrow / std::max(1.0, n - weight);
    wide = std::max(of_wide / std::max(1e-9, weight), 2.0 * narrow);
    if (std::abs(share - share_before) < settled * share &&
        std::abs(wide - wide_before) < settled * wide)
      break;
  }
  return {share, narrow, wide};
}

/// Likewise; small squares are all the narrow one's.
OutlierMixture about_a_size(const std::vector<double>& squares, const OutlierMixture& about_zero) {
  const auto n = static_cast<double>(squares.size());
  OutlierMixture m = about_zero;
  const double total = std::accumulate(squares.begin(), squares.end(), 0.0);
  std::vector<double> large;
  for (const double s : squares)
    if (s > 4.0 * m.narrow) large.push_back(s);
  m.size = std::sqrt(0.8 * about_zero.wide);
  m.wide = std::max(0.2 * about_zero.wide, m.narrow);
  for (int pass = 0; pass < 200; ++pass) {
    double weight = 0.0, sizes = 0.0, hits = 0.0;
    for (const double s : large) {
      const double hit = 1.0 / (1.0 + std::exp(-m.log_odds(s)));
      const double root = std::sqrt(s);
      weight += hit;
      sizes += hit * root * std::tanh(m.size * root / m.wide);
      hits += hit * s;
    }
    if (weight < 1.0) return about_zero;
    const OutlierMixture before = m;
    m.share = std::clamp(weight / n, 1e-6, 0.5);
    m.narrow = (total - hits) / (n - weight);
    m.size = sizes / weight;
    m.wide = std::max(hits / weight - m.size * m.size, m.narrow);
    if (std::abs(m.share - before.share) < settled * m.share &&
        std::abs(m.size - before.size) < settled * m.size &&
        std::abs(m.wide - before.wide) < settled * m.wide)
      break;
  }
  return m;
}

}  // namespace

OutlierMixture outlier_mixture(const std::vector<double>& squares, double narrow) {
  const OutlierMixture plain = weighed(about_zero(squares, narrow), squares);
  // Too few to have a size, or none.
  const double value = 0.5 * std::log(static_cast<double>(squares.size()));
  if (plain.share * static_cast<double>(squares.size()) < 10.0 || plain.gain < value) return plain;
  const OutlierMixture sized = weighed(about_a_size(squares, plain), squares);
  return sized.gain > plain.gain + value ? sized : plain;
}

}  // namespace gyrostat::gap
