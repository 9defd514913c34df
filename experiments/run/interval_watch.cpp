#include <gyrostat/experiments/run/interval_watch.hpp>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/core/outcome.hpp>

namespace gyrostat {

IntervalWatch::IntervalWatch(const Cell& cell)
    : metric_(metric_named(judging_metric(cell), "progress")), means_(cell.methods.size()) {
  for (const auto& method : cell.methods) methods_.push_back(method.id);
}

void IntervalWatch::add(std::span<const double> outcomes) {
  const TrialOutcomes of(outcomes, means_.size());
  for (std::size_t m = 0; m < means_.size(); ++m) {
    const double value = of[m].metric(metric_);
    if (std::isfinite(value)) means_[m].add(value);
  }
}

IntervalWatch::Widest IntervalWatch::widest() const {
  Widest widest;
  for (std::size_t m = 0; m < means_.size(); ++m) {
    const double half_width = half_width_95(means_[m]);
    if (std::isnan(half_width)) continue;
    if (!(half_width <= widest.half_width)) widest = {methods_[m], half_width};
  }
  return widest;
}

}  // namespace gyrostat
