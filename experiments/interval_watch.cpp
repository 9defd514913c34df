#include "experiments/interval_watch.hpp"

#include "experiments/cell_summary.hpp"

namespace gyrostat {

IntervalWatch::IntervalWatch(const Cell& cell)
    : metric_(metric_named(std::string(judging_metric(cell)), "progress")),
      moments_(cell.methods.size()) {
  for (const auto& method : cell.methods) methods_.push_back(method.id);
}

void IntervalWatch::add(std::span<const double> outcomes) {
  const std::size_t columns = outcomes.size() / moments_.size();
  for (std::size_t m = 0; m < moments_.size(); ++m) {
    const double value = outcomes[m * columns + metric_];
    if (!std::isfinite(value)) continue;
    auto& [count, mean, squares] = moments_[m];
    const double step = value - mean;
    mean += step / ++count;
    squares += step * (value - mean);
  }
}

IntervalWatch::Widest IntervalWatch::widest() const {
  constexpr double normal_95 = 1.959963984540054;
  Widest widest;
  for (std::size_t m = 0; m < moments_.size(); ++m) {
    const auto& [count, mean, squares] = moments_[m];
    if (count < 2.0) continue;
    const double half_width = normal_95 * std::sqrt(squares / (count - 1.0) / count);
    if (!(half_width <= widest.half_width)) widest = {methods_[m], half_width};
  }
  return widest;
}

}  // namespace gyrostat
