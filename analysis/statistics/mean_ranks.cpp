#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/mean_ranks.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <boost/math/tools/roots.hpp>

namespace gyrostat {
namespace {

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// P(range of k normals <= q) = k int phi(z) (Phi(z + q) - Phi(z))^(k - 1) dz over the least of
/// them. The integrand falls off like a normal density, so equal steps converge exponentially.
double range_cdf(double q, double k) {
  constexpr double step = 0.02, far = 9.0;
  double sum = 0.0;
  for (double z = -far - q; z <= far; z += step)
    sum += std::exp(-0.5 * z * z) * std::pow(normal_cdf(z + q) - normal_cdf(z), k - 1.0);
  return k * sum * step / std::sqrt(2.0 * std::numbers::pi);
}

}  // namespace

std::vector<double> mid_ranks(std::span<const double> values) {
  const auto key = [&](std::size_t i) { return std::isnan(values[i]) ? HUGE_VAL : values[i]; };
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<double> ranks(values.size());
  for (std::size_t from = 0, to; from < order.size(); from = to) {
    for (to = from + 1; to < order.size() && key(order[to]) == key(order[from]);) ++to;
    for (std::size_t i = from; i < to; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(from + 1 + to);
  }
  return ranks;
}

double studentised_range_quantile(double confidence, std::size_t groups) {
  const double k = static_cast<double>(groups);
  boost::uintmax_t steps = 100;
  const auto [low, high] =
      boost::math::tools::toms748_solve([&](double q) { return range_cdf(q, k) - confidence; }, 0.0,
                                        20.0, boost::math::tools::eps_tolerance<double>(40), steps);
  return 0.5 * (low + high);
}

void RankStatistics::add(std::span<const double> values) {
  ++count_;
  const auto ranks = mid_ranks(values);
  for (std::size_t m = 0; m < ranks.size(); ++m) {
    sums_[m] += ranks[m];
    all_squares_ += ranks[m] * ranks[m];
  }
}

double RankStatistics::mean_rank(std::size_t method) const {
  return count_ > 0 ? sums_[method] / static_cast<double>(count_) : no_value;
}

double RankStatistics::critical_difference() const {
  if (sums_.size() < 2 || count_ == 0) return no_value;
  const double k = static_cast<double>(sums_.size()), n = static_cast<double>(count_);
  // A search for the quantile takes milliseconds, and all cells of a study have as many methods.
  thread_local std::pair<std::size_t, double> last;
  if (last.first != sums_.size())
    last = {sums_.size(), studentised_range_quantile(0.95, sums_.size())};
  return last.second * std::sqrt(k * (k + 1.0) / (12.0 * n));
}

double RankStatistics::friedman_p() const {
  if (sums_.size() < 2 || count_ == 0) return no_value;
  const double k = static_cast<double>(sums_.size()), n = static_cast<double>(count_);
  const double middle = n * (k + 1.0) / 2.0;
  double between = 0.0;
  for (const double sum : sums_) between += (sum - middle) * (sum - middle);
  const double within = all_squares_ - n * k * (k + 1.0) * (k + 1.0) / 4.0;
  if (!(within > 0.0)) return 1.0;  // every trial is one tie
  return chi_squared_upper_tail((k - 1.0) * between / within, k - 1.0);
}

}  // namespace gyrostat
