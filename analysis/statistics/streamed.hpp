#pragma once

#include <span>

#include <gyrostat/analysis/statistics/order_statistic.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>

namespace gyrostat {

/// The Summary of values that come by as often as it asks for them and are never held together: the
/// same bits as `summarise` gives for all of them at once.
class StreamedSummary {
 public:
  void add(double value);
  /// Ends a pass; whether another one over the same values, in the same order, is needed.
  bool another_pass();
  /// Of the passes so far; the mean is right after the first.
  const Summary& summary() const { return summary_; }

 private:
  int passes_ = 0;
  double sum_ = 0.0;
  Running about_mean_;
  bool median_known_ = false, percentile_known_ = false;
  OrderStatistic median_, percentile_;
  Summary summary_;
};

}  // namespace gyrostat
