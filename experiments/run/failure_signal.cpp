#include <gyrostat/experiments/run/failure_signal.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat {
namespace {

std::vector<NoiseShare> scaled(std::vector<NoiseShare> shares, double by) {
  for (auto& share : shares) share.weight *= by;
  return shares;
}

/// The squared length of what vectors that come one by one have in common: their mean product.
struct Common {
  std::vector<double> sum;
  double squares = 0.0;

  void add(const std::vector<double>& values) {
    if (sum.size() < values.size()) sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      squares += values[i] * values[i];
    }
  }
  double squared_length(double count) const {
    double all = 0.0;
    for (const double s : sum) all += s * s;
    return (all - squares) / (count * (count - 1.0));
  }
};

}  // namespace

std::optional<FailureSignal> failure_signal(const PreparedCell& prepared, const FailureRule& rule,
                                            const FailingMeans& means, std::uint64_t seed) {
  std::map<std::string, Common> streams;
  for (const auto& of_run : means.of_runs)
    for (const auto& [name, deviates] : of_run) streams[name].add(deviates);

  FailureSignal signal;
  double squared = 0.0;
  for (const auto& [name, common] : streams) {
    const double part =
        std::max(0.0, common.squared_length(static_cast<double>(means.of_runs.size())));
    signal.drivers[name] = part;
    squared += part;
  }
  if (!(squared > 0.0)) return std::nullopt;
  for (auto& [name, part] : signal.drivers) part /= squared;

  std::vector<Workspace> workspaces(1);
  const auto metric_at = [&](double scale) {
    const auto shares = scaled(means.shares, scale);
    return run_trial(prepared.cell, prepared.calibration, Noise{seed, 0, shares}, workspaces)
        .of(0)
        .metric(rule.metric);
  };
  const auto excess = [&](double metric) {
    return std::clamp(rule.badness(metric) - rule.worst_allowed(), -1e300, 1e300);
  };
  // The mean of failing trials lies a little beyond the design point.
  double low = 0.0, high = 1.0, metric = metric_at(high);
  for (; excess(metric) <= 0.0 && high < 4.0; metric = metric_at(high)) low = high, high *= 1.25;
  if (excess(metric) <= 0.0) return std::nullopt;
  for (int step = 0; step < 12; ++step) {
    const double middle = 0.5 * (low + high), there = metric_at(middle);
    if (excess(there) > 0.0)
      high = middle, metric = there;
    else
      low = middle;
  }
  signal.shares = scaled(means.shares, high);
  signal.metric = metric;
  signal.distance = high * std::sqrt(squared);
  signal.same_side = means.same_side;
  return signal;
}

}  // namespace gyrostat
