#include <gyrostat/analysis/statistics/tail_mean.hpp>

#include <cmath>

#include <gyrostat/analysis/statistics/skewed_mean.hpp>

namespace gyrostat {

void StreamedTailMean::add(double value) {
  if (std::isnan(value)) return;
  if (!quantile_known_) return order_.add(value);
  if (value <= quantile_) return;
  const double excess = (value - quantile_) / tail_share;
  sums_[0] += excess;
  sums_[1] += excess * excess;
  sums_[2] += excess * excess * excess;
}

bool StreamedTailMean::another_pass() {
  const double n = static_cast<double>(order_.count());
  if (order_.count() == 0) return false;
  if (!quantile_known_) {
    const double at = (1.0 - tail_share) * (n - 1.0);
    if (order_.another_pass(static_cast<std::size_t>(at))) return true;
    quantile_known_ = true;
    quantile_ = std::lerp(order_.value(), order_.next_value(), at - std::floor(at));
    return true;
  }
  const double mean = sums_[0] / n;
  const double second = sums_[1] / n - mean * mean;
  const double third = sums_[2] / n - 3.0 * mean * sums_[1] / n + 2.0 * mean * mean * mean;
  tail_.value = quantile_ + mean;
  if (n < fewest_for_tail_interval || !(second > 0.0)) return false;
  const auto [low, high] = skewed_mean_interval({n, tail_.value, n * second, n * third}, 0.025);
  tail_.low = low;
  tail_.high = high;
  return false;
}

}  // namespace gyrostat
