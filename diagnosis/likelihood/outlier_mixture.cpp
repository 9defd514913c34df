#include <gyrostat/diagnosis/likelihood/outlier_mixture.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gyrostat::gap {
namespace {

constexpr double least_share = 1e-6, most_share = 0.5;
constexpr double most_of_all = 0.75;  ///< the narrow one has the rest
constexpr std::size_t most_wide = 5;

/// Of a component about +size or -size, but for a constant.
double log_density(double square, double variance, double size) {
  const double along = size * std::sqrt(square) / variance;
  return -0.5 * std::log(variance) - 0.5 * (square + size * size) / variance + along +
         std::log1p(std::exp(-2.0 * along)) - std::log(2.0);
}

double log_of_sum(double a, double b) {
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

/// Squares that differ by half a percent count as one.
struct Alike {
  double square = 0.0, count = 0.0;
};

std::vector<Alike> gathered(const std::vector<double>& squares, double narrow) {
  constexpr double ratio = 0.005, least = 1e-4, smallest = 1e-300;
  narrow = std::max(narrow, smallest);
  std::map<int, Alike> bins;
  for (const double s : squares) {
    auto& bin = bins[static_cast<int>(std::log(std::max(s / narrow, least) / least) / ratio)];
    bin.square += s;
    bin.count += 1.0;
  }
  std::vector<Alike> alike;
  for (const auto& [_, bin] : bins) alike.push_back({bin.square / bin.count, bin.count});
  return alike;
}

double log_narrow(const OutlierMixture& m, double square) {
  return std::log(1.0 - m.share()) + log_density(square, m.narrow, 0.0);
}

double log_wide(const OutlierMixture::Wide& w, double square) {
  return std::log(w.share) + log_density(square, w.variance, w.size);
}

/// With the likelihood gained by the components.
OutlierMixture weighed(OutlierMixture m, const std::vector<Alike>& alike) {
  double n = 0.0, total = 0.0, mixed = 0.0;
  for (const auto& [square, count] : alike) {
    double log_sum = log_narrow(m, square);
    for (const auto& w : m.wide) log_sum = log_of_sum(log_sum, log_wide(w, square));
    n += count;
    total += count * square;
    mixed += count * log_sum;
  }
  m.gain = mixed + 0.5 * n * (std::log(total / n) + 1.0);
  return m;
}

/// One pass; whether it changed hardly anything.
bool improve(OutlierMixture& m, const std::vector<Alike>& alike) {
  constexpr double settled = 1e-5;
  struct Sums {
    double weight = 0.0, squares = 0.0, sizes = 0.0;
  };
  std::vector<Sums> sums(m.wide.size());
  Sums narrow;
  for (const auto& [square, count] : alike) {
    std::array<double, most_wide> logs{};
    const double of_narrow = log_narrow(m, square);
    double log_sum = of_narrow;
    for (std::size_t k = 0; k < m.wide.size(); ++k)
      log_sum = log_of_sum(log_sum, logs[k] = log_wide(m.wide[k], square));
    const double rest = count * std::exp(of_narrow - log_sum);
    narrow.weight += rest;
    narrow.squares += rest * square;
    const double root = std::sqrt(square);
    for (std::size_t k = 0; k < m.wide.size(); ++k) {
      const double hit = count * std::exp(logs[k] - log_sum);
      sums[k].weight += hit;
      sums[k].squares += hit * square;
      sums[k].sizes += hit * root * std::tanh(m.wide[k].size * root / m.wide[k].variance);
    }
  }
  double n = narrow.weight;
  for (const auto& s : sums) n += s.weight;
  m.narrow = narrow.squares / std::max(1.0, narrow.weight);
  bool is_settled = true;
  for (std::size_t k = 0; k < m.wide.size(); ++k) {
    auto& w = m.wide[k];
    const auto before = std::exchange(
        w, {std::clamp(sums[k].weight / n, least_share, most_share), w.variance, w.size});
    const double weight = std::max(1e-9, sums[k].weight);
    w.size = sums[k].sizes / weight;
    // About zero it is the noise's, if it is not clearly wider.
    w.variance = std::max(sums[k].squares / weight - w.size * w.size,
                          w.size > 0.0 ? m.narrow : 2.0 * m.narrow);
    const auto is_near = [](double a, double b) {
      return std::abs(a - b) <= settled * std::abs(a);
    };
    is_settled = is_settled && is_near(w.share, before.share) &&
                 is_near(w.variance, before.variance) && is_near(w.size, before.size);
  }
  if (const double all = m.share(); all > most_of_all)
    for (auto& w : m.wide) w.share *= most_of_all / all;
  return is_settled;
}

OutlierMixture fitted(OutlierMixture m, const std::vector<Alike>& alike) {
  constexpr int most_passes = 300;
  for (int pass = 0; pass < most_passes; ++pass)
    if (improve(m, alike)) break;
  return weighed(std::move(m), alike);
}

}  // namespace

double OutlierMixture::share() const {
  double sum = 0.0;
  for (const auto& w : wide) sum += w.share;
  return sum;
}

double OutlierMixture::log_odds(double square) const {
  double log_sum = -1e300;
  for (const auto& w : wide) log_sum = log_of_sum(log_sum, log_wide(w, square));
  return log_sum - log_narrow(*this, square);
}

OutlierMixture outlier_mixture(const std::vector<double>& squares, double narrow) {
  const auto n = static_cast<double>(squares.size());
  const auto alike = gathered(squares, narrow);
  auto best = fitted({.narrow = narrow, .wide = {{0.003, 25.0 * narrow}}}, alike);
  // Too few to have a form, or none.
  const double value = 0.5 * std::log(n);
  const auto plain = best.wide.front();
  if (plain.share * n < 10.0 || best.gain < value) return best;
  const auto consider = [&, from = best.narrow](std::vector<OutlierMixture::Wide> wide,
                                                double values) {
    auto other = fitted({.narrow = from, .wide = std::move(wide)}, alike);
    other.gain -= values * value;
    if (other.gain > best.gain) best = std::move(other);
  };
  consider(
      {{plain.share, std::max(0.2 * plain.variance, best.narrow), std::sqrt(0.8 * plain.variance)}},
      1.0);
  // The common ones, and rare ones that are larger yet.
  for (const double common : {1.0, 3.0})
    consider({{std::min(most_share, common * plain.share), plain.variance / common},
              {std::max(0.05 * plain.share, 3.0 / n), 4.0 * plain.variance}},
             2.0);
  // Tails that go on as a power do are as many as they have decades of chances.
  for (std::size_t known = 0; known != best.wide.size() && best.wide.size() < most_wide;) {
    known = best.wide.size();
    auto wide = best.wide;
    const auto last = *std::max_element(wide.begin(), wide.end(), [](const auto& a, const auto& b) {
      return a.variance < b.variance;
    });
    wide.push_back({std::max(0.05 * last.share, 3.0 / n), 4.0 * last.variance});
    if (known > 1) consider(std::move(wide), 2.0 * static_cast<double>(known));
  }
  return best;
}

}  // namespace gyrostat::gap
