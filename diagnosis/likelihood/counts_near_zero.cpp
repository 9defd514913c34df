#include <gyrostat/diagnosis/likelihood/counts_near_zero.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr int reach = reach_of_zero;
constexpr std::size_t values_near = 2 * reach + 1;
using Shares = CountsNearZero;

/// Normal, but for a share of wider values, or about a sine; in steps.
struct Noise {
  double deviation, wide_share = 0.0, times_wider = 1.0;
  double sine = 0.0;  // amplitude

  double below(double high, double level) const {
    if (sine == 0.0)
      return (1.0 - wide_share) * gap::below(high, level, deviation) +
             wide_share * gap::below(high, level, times_wider * deviation);
    constexpr int phases = 8;  // Chebyshev's nodes
    double sum = 0.0;
    for (int k = 0; k < phases; ++k)
      sum += gap::below(high, level + sine * std::cos(std::numbers::pi * (k + 0.5) / phases),
                        deviation);
    return sum / phases;
  }
};

/// Of the cell of k, in steps; what is cut off leaves none between -1 and 1 but that of zero.
double edge_below(int k, bool cut_off) {
  if (!cut_off) return k - 0.5;
  return k > 0 ? k : k - 1;
}

/// What the values near zero are at every level, under one noise.
class Laws {
 public:
  Laws(const Noise& noise, bool cut_off) {
    constexpr double farthest = 8.0, least_apart = 0.125;
    const double apart = std::max(least_apart, 0.25 * noise.deviation);
    for (double level = -farthest; level <= farthest; level += apart) {
      Shares shares;
      double below = noise.below(edge_below(-reach, cut_off), level);
      for (int k = -reach; k <= reach; ++k) {
        const double next = noise.below(edge_below(k + 1, cut_off), level);
        shares[static_cast<std::size_t>(k + reach)] = std::max(next - below, 1e-12);
        below = next;
      }
      const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
      for (double& share : shares) share /= all;
      shares_.push_back(shares);
      for (double& share : shares) share = std::log(share);
      logarithms_.push_back(shares);
    }
  }

  struct Best {
    double log_likelihood = -1e300;
    const Shares* shares = nullptr;
  };
  Best best(const Shares& counts) const {
    Best best;
    for (std::size_t k = 0; k < shares_.size(); ++k)
      if (const double likelihood =
              std::inner_product(counts.begin(), counts.end(), logarithms_[k].begin(), 0.0);
          likelihood > best.log_likelihood)
        best = {likelihood, &shares_[k]};
    return best;
  }

 private:
  std::vector<Shares> shares_, logarithms_;
};

std::vector<Laws> laws_of(const std::vector<Noise>& noises, bool cut_off) {
  std::vector<Laws> laws;
  for (const auto& noise : noises) laws.emplace_back(noise, cut_off);
  return laws;
}

/// How well the counts of some stretches are foretold.
class Foretold {
 public:
  void add(const Laws::Best& best, const Shares& counts) {
    log_likelihood_ += best.log_likelihood;
    const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
    for (std::size_t k = 0; k < values_near; ++k) {
      observed_[k] += counts[k];
      expected_[k] += all * (*best.shares)[k];
    }
  }

  double log_likelihood() const { return log_likelihood_; }
  /// Of all stretches together.
  double chi_squared() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < values_near; ++k)
      sum += (observed_[k] - expected_[k]) * (observed_[k] - expected_[k]) / (expected_[k] + 1.0);
    return sum;
  }

 private:
  double log_likelihood_ = 0.0;
  Shares observed_{}, expected_{};
};

/// Of the noises that are tried.
enum class Shape { normal, any };

/// Every stretch has a level of its own, all have one noise, which may have heavy tails or a sine.
Foretold foretold(const std::vector<Shares>& stretches, bool cut_off, Shape shape) {
  constexpr double narrowest = 0.125, widest = 16.0, wider = 1.19;
  std::vector<Noise> noises;
  for (double deviation = narrowest; deviation < widest; deviation *= wider) {
    noises.push_back({deviation});
    if (shape == Shape::normal) continue;
    for (const double wide_share : {0.003, 0.01, 0.03, 0.1})
      for (const double times_wider : {2.0, 3.0, 6.0})
        noises.push_back({deviation, wide_share, times_wider});
    for (const double sine : {1.0, 1.5, 2.0, 3.0})
      noises.push_back({.deviation = deviation, .sine = sine * deviation});
  }
  std::optional<Foretold> best;
  for (const auto& law : laws_of(noises, cut_off)) {
    Foretold by_law;
    for (const auto& counts : stretches) by_law.add(law.best(counts), counts);
    if (!best || by_law.log_likelihood() > best->log_likelihood()) best = by_law;
  }
  return *best;
}

}  // namespace

bool are_cut_off(std::vector<CountsNearZero> stretches) {
  std::erase_if(stretches, [](const auto& counts) {
    return std::count(counts.begin(), counts.end(), 0.0) == values_near - 1;
  });
  const auto both = [&](Shape shape) {
    return std::pair(foretold(stretches, false, shape), foretold(stretches, true, shape));
  };
  // A wide zero shows under normal laws, too; they are few.
  if (const auto [rounded, cut_off] = both(Shape::normal);
      cut_off.log_likelihood() <= rounded.log_likelihood())
    return false;
  // Of three values tails say as much as the width of zero does, where levels hardly move.
  constexpr double clear_nats = 20.0, nats_of_stretch = 1.0;
  constexpr double most_of_it = 0.2;
  const auto [rounded, cut_off] = both(Shape::any);
  return cut_off.log_likelihood() > rounded.log_likelihood() + clear_nats +
                                        nats_of_stretch * static_cast<double>(stretches.size()) &&
         cut_off.chi_squared() < most_of_it * rounded.chi_squared();
}

}  // namespace gyrostat::gap
