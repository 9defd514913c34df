#pragma once

#include <gyrostat/analysis/statistics/order_statistic.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

inline constexpr double tail_share = 0.05;
inline constexpr double fewest_for_tail_interval = 200;  ///< ten in the tail

/// The mean of the worst 5 % (conditional value at risk, expected shortfall) with its 95 %
/// interval.
struct TailMean {
  double value = no_value;
  double low = no_value, high = no_value;  ///< no value for fewer than 200 values
};

/// CVaR of values that come by as often as it asks for them: v + mean((x - v)+) / 0.05 with v the
/// 95 % quantile (Rockafellar and Uryasev, J. Risk 2, 2000, eq. 4). The error of v has no
/// first-order effect, so this is the mean of independent values; they are skewed, hence
/// `skewed_mean_interval`.
class StreamedTailMean {
 public:
  void add(double value);  ///< NaN is left out
  bool another_pass();
  const TailMean& tail() const { return tail_; }

 private:
  OrderStatistic order_;
  bool quantile_known_ = false;
  double quantile_ = 0.0;
  double sums_[3] = {};  ///< of the excess over the quantile and of its square and cube
  TailMean tail_;
};

}  // namespace gyrostat
