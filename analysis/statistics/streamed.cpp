#include <gyrostat/analysis/statistics/streamed.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat {
namespace {

constexpr double high_share = 0.95;

double at_share(double share, std::size_t count) { return share * static_cast<double>(count - 1); }

/// Linear interpolation between order statistics (Hyndman and Fan 1996, type 7).
double interpolated(const OrderStatistic& below, double share) {
  const double at = at_share(share, below.count());
  return std::lerp(below.value(), below.next_value(), at - std::floor(at));
}

}  // namespace

void StreamedSummary::add(double value) {
  if (std::isnan(value)) {
    summary_.missing += passes_ == 0;
    return;
  }
  if (passes_ == 0) {
    ++summary_.count;
    sum_ += value;
    const double size = std::abs(value);
    summary_.worst = std::isnan(summary_.worst) ? size : std::max(summary_.worst, size);
  } else if (passes_ == 1) {
    const double d = value - summary_.mean;
    about_mean_.squares += d * d;
    about_mean_.cubes += d * d * d;
  }
  if (!median_known_) median_.add(value);
  if (!percentile_known_) percentile_.add(std::abs(value));
}

bool StreamedSummary::another_pass() {
  ++passes_;
  if (summary_.count == 0) return false;
  const double n = static_cast<double>(summary_.count);
  if (passes_ == 1) summary_.mean = sum_ / n;
  if (passes_ == 2) {
    about_mean_.count = n;
    summary_.std = about_mean_.std();
    summary_.half_width_95 = half_width_95(about_mean_);
  }
  const auto rank = [&](double share) {
    return static_cast<std::size_t>(at_share(share, summary_.count));
  };
  if (!median_known_ && !median_.another_pass(rank(0.5))) {
    median_known_ = true;
    summary_.median = interpolated(median_, 0.5);
  }
  if (!percentile_known_ && !percentile_.another_pass(rank(high_share))) {
    percentile_known_ = true;
    summary_.percentile_95 = interpolated(percentile_, high_share);
  }
  return passes_ < 2 || !median_known_ || !percentile_known_;
}

}  // namespace gyrostat
