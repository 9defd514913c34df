#include <gyrostat/diagnosis/likelihood/truncation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr int reach = 3;  // steps either side of zero that are looked at
constexpr std::size_t values_near = 2 * reach + 1;
using Shares = std::array<double, values_near>;

constexpr std::size_t stretch = 256;  // samples, over which the level is one

/// Of normal values within reach of zero; in steps.
Shares shares_of(double level, double deviation, bool cut_off) {
  Shares shares;
  for (int k = -reach; k <= reach; ++k) {
    const double low = cut_off ? (k > 0 ? k : k - 1) : k - 0.5;
    const double high = cut_off ? (k < 0 ? k : k + 1) : k + 0.5;
    shares[static_cast<std::size_t>(k + reach)] =
        std::max(below(high, level, deviation) - below(low, level, deviation), 1e-12);
  }
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= all;
  return shares;
}

/// All normal laws that are tried.
std::vector<Shares> laws(bool cut_off) {
  constexpr double narrowest = 0.25, widest = 16.0, wider = 1.19;
  constexpr double farthest = 4.0, apart = 0.125;
  std::vector<Shares> all;
  for (double deviation = narrowest; deviation < widest; deviation *= wider)
    for (double level = -farthest; level <= farthest; level += apart)
      all.push_back(shares_of(level, deviation, cut_off));
  return all;
}

/// Logarithms, to be weighed by counts.
std::vector<Shares> logarithms(std::vector<Shares> all) {
  for (auto& shares : all)
    for (double& share : shares) share = std::log(share);
  return all;
}

/// How well normal laws foretell the counts of some stretches, each its own.
class Foretold {
 public:
  explicit Foretold(bool cut_off) : laws_(laws(cut_off)), logarithms_(logarithms(laws_)) {}

  void add(const Shares& counts) {
    double best = -1e300;
    std::size_t at = 0;
    for (std::size_t k = 0; k < laws_.size(); ++k)
      if (const double likelihood =
              std::inner_product(counts.begin(), counts.end(), logarithms_[k].begin(), 0.0);
          likelihood > best) {
        best = likelihood;
        at = k;
      }
    log_likelihood_ += best;
    const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
    for (std::size_t k = 0; k < values_near; ++k) expected_[k] += all * laws_[at][k];
  }

  double log_likelihood() const { return log_likelihood_; }
  /// Of all stretches together.
  double chi_squared(const Shares& observed) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < values_near; ++k)
      sum += (observed[k] - expected_[k]) * (observed[k] - expected_[k]) / (expected_[k] + 1.0);
    return sum;
  }

 private:
  std::vector<Shares> laws_, logarithms_;
  double log_likelihood_ = 0.0;
  Shares expected_{};
};

template <class Do>
void each_stretch(std::span<const Span> spans, const Do& act) {
  for (const auto& span : spans)
    for (std::size_t first = span.first; first < span.last; first += stretch)
      act(first, std::min(first + stretch, span.last));
}

}  // namespace

bool is_cut_off(const Conditions& conditions, const std::vector<double>& z, double lsb_dps) {
  if (!(lsb_dps > 0.0)) return false;
  constexpr double fewest = 20.0;   // within reach, of a stretch that says anything
  constexpr std::size_t shape = 4;  // values: three of a normal law show no shape but their shares'
  constexpr double clear = 20.0;    // nats
  constexpr double nearly_all = 0.1;
  Foretold rounded(false), cut_off(true);
  Shares observed{};
  each_stretch(conditions.spans(Part::train), [&](std::size_t first, std::size_t last) {
    Shares counts{};
    for (std::size_t i = first; i < last; ++i)
      if (const double k = std::nearbyint(z[i] / lsb_dps); std::abs(k) <= reach)
        counts[static_cast<std::size_t>(static_cast<int>(k) + reach)] += 1.0;
    if (std::accumulate(counts.begin(), counts.end(), 0.0) < fewest ||
        std::count(counts.begin(), counts.end(), 0.0) > static_cast<long>(values_near - shape))
      return;
    rounded.add(counts);
    cut_off.add(counts);
    for (std::size_t k = 0; k < values_near; ++k) observed[k] += counts[k];
  });
  return cut_off.log_likelihood() > rounded.log_likelihood() + clear &&
         cut_off.chi_squared(observed) < nearly_all * rounded.chi_squared(observed);
}

std::vector<double> middles_of_cut_off(const Conditions& conditions, const std::vector<double>& z,
                                       double lsb_dps) {
  const auto& reference = conditions.series().rate_ref_dps;
  const auto known = [&](std::size_t i) { return reference.empty() ? 0.0 : reference[i]; };
  auto middles = z;
  for (double& value : middles)
    if (value != 0.0) value += std::copysign(0.5 * lsb_dps, value);
  const NormalStream either(0, 0, "side of a zero");
  for (const Part part : both_parts)
    each_stretch(conditions.spans(part), [&](std::size_t first, std::size_t last) {
      double sum = 0.0, squares = 0.0, count = 0.0;
      for (std::size_t i = first; i < last; ++i) {
        const double error = middles[i] - known(i);
        if (is_missing(error)) continue;
        sum += error;
        squares += error * error;
        count += 1.0;
      }
      if (count == 0.0) return;
      const double bias = sum / count;
      const double deviation =
          std::max(std::sqrt(std::max(squares / count - bias * bias, 0.0)), 0.1 * lsb_dps);
      for (std::size_t i = first; i < last; ++i) {
        if (z[i] != 0.0 || is_missing(known(i))) continue;
        const double level = known(i) + bias;
        const double negative = below(0.0, level, deviation) - below(-lsb_dps, level, deviation);
        const double positive = below(lsb_dps, level, deviation) - below(0.0, level, deviation);
        const bool is_negative = either.uniform(i) * (negative + positive) < negative;
        middles[i] = is_negative ? -0.5 * lsb_dps : 0.5 * lsb_dps;
      }
    });
  return middles;
}

}  // namespace gyrostat::gap
