#include <gyrostat/diagnosis/remainder/distribution.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/generators/effects/empirical_distribution.hpp>

namespace gyrostat::gap {
namespace {

/// Shares of samples farther out than each knot.
constexpr std::array tails = {0.5, 0.2, 0.07, 0.02, 5e-3, 1e-3, 3e-4, 1e-4};
static_assert(tails.size() == effects::EmpiricalDistribution::most_knots);
constexpr double fewest_beyond = 1.0;

double beyond_all_but(const std::vector<double>& rising, double share) {
  const auto last = static_cast<double>(rising.size() - 1);
  return rising[static_cast<std::size_t>(std::llround((1.0 - share) * last))];
}

/// 2 sum of n ln(n / expected) over the bins between the edges.
double likelihood_ratio(const std::vector<double>& rising, const std::vector<double>& edges,
                        const std::vector<double>& shares) {
  double ratio = 0.0;
  auto from = rising.begin();
  const auto all = static_cast<double>(rising.size());
  for (std::size_t bin = 0; bin < shares.size(); ++bin) {
    const auto to =
        bin < edges.size() ? std::upper_bound(from, rising.end(), edges[bin]) : rising.end();
    const auto count = static_cast<double>(to - from);
    if (count > 0.0) ratio += 2.0 * count * std::log(count / (all * shares[bin]));
    from = to;
  }
  return ratio;
}

std::string in_words(double from, double to, double share) {
  // As many digits as tell them apart.
  int digits = 2;
  while (digits < 6 && fmt::format("{:.{}g}", from, digits) == fmt::format("{:.{}g}", to, digits))
    ++digits;
  return fmt::format("{} tails of the noise (one sample in {:.0f} beyond {:.{}g} dps, not {:.{}g})",
                     to > from ? "heavier" : "lighter", 1.0 / share, to, digits, from, digits);
}

}  // namespace

std::optional<Nameless> distribution_part(const Replicated& replicated) {
  const auto& own = replicated.recording.fast_dps;
  std::vector<double> pooled;
  for (const auto& replica : replicated.replicas)
    pooled.insert(pooled.end(), replica.fast_dps.begin(), replica.fast_dps.end());
  std::sort(pooled.begin(), pooled.end());
  if (own.empty() || pooled.empty()) return std::nullopt;
  effects::EmpiricalDistribution map = effects::EmpiricalDistribution::absent();
  Effect effect = map;
  std::vector<double> edges, shares;
  double before = 1.0, furthest = 0.0;
  std::size_t knot = 0;
  double from = 0.0, to = 0.0;
  for (const double tail : tails) {
    if (tail * static_cast<double>(own.size()) < fewest_beyond) break;
    const double edge = beyond_all_but(pooled, tail);
    // Of values on a grid, several quantiles may be one.
    if (!(edge > (edges.empty() ? 0.0 : edges.back()))) continue;
    const auto within =
        static_cast<double>(std::upper_bound(pooled.begin(), pooled.end(), edge) - pooled.begin());
    const double beyond = 1.0 - within / static_cast<double>(pooled.size());
    if (!(beyond > 0.0)) break;
    edges.push_back(edge);
    shares.push_back(before - beyond);
    before = beyond;
    effect.value(2 * knot) = from = edge;
    effect.value(2 * knot + 1) = to = beyond_all_but(own, beyond);
    furthest = beyond;
    ++knot;
  }
  if (edges.empty()) return std::nullopt;
  shares.push_back(before);
  double typical = 0.0;
  for (const auto& replica : replicated.replicas)
    typical += likelihood_ratio(replica.fast_dps, edges, shares) /
               static_cast<double>(replicated.replicas.size());
  const auto freedom = static_cast<double>(edges.size());
  const double scale = std::max(1.0, typical / freedom);
  const double gain = 0.5 * likelihood_ratio(own, edges, shares) / scale - freedom;
  if (gain < clear_gain) return std::nullopt;
  return Nameless{effect, in_words(from, to, furthest)};
}

}  // namespace gyrostat::gap
