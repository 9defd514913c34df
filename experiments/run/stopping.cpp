#include <gyrostat/experiments/run/stopping.hpp>

#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/analysis/statistics/sequential.hpp>
#include <gyrostat/analysis/statistics/skewed_mean.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/core/outcome.hpp>
#include <gyrostat/results/render/interval.hpp>

namespace gyrostat {
namespace {

/// The looks at a cell's results up to `trials`; its end is one, whatever ended it.
std::vector<std::uint32_t> looks_up_to(const StopRule& rule, std::uint32_t trials) {
  auto counts = look_counts(rule.at_least, trials);
  if (counts.empty() || counts.back() != trials) counts.push_back(trials);
  return counts;
}

std::optional<std::string> narrow_enough(const Cell& cell, const OutcomeSource& trials) {
  const auto& rule = *cell.stop;
  std::vector<Running> means(rule.methods.size());
  trials([&](std::span<const double> numbers) {
    const TrialOutcomes outcomes(numbers, cell.methods.size());
    for (std::size_t i = 0; i < means.size(); ++i)
      means[i].add(outcomes[rule.methods[i]].metric(rule.metric));
  });
  double widest = no_value;
  for (const auto& m : means) {
    if (m.count == 0.0) continue;  // a method without this metric
    widest = std::fmax(widest, m.count < 2.0 ? HUGE_VAL : half_width_95(m));
  }
  if (!(widest < rule.half_width_below)) return std::nullopt;
  return fmt::format("mean {} known to ± {:.3g} {}", metric_types()[rule.metric].id, widest,
                     std::string(metric_types()[rule.metric].unit));
}

std::optional<std::string> told_apart(const Cell& cell, std::uint32_t count,
                                      const OutcomeSource& trials) {
  const auto& rule = *cell.stop;
  struct Pair {
    std::size_t a, b;
    Running difference;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < rule.methods.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs.push_back({rule.methods[j], rule.methods[i], {}});
  trials([&](std::span<const double> numbers) {
    const TrialOutcomes outcomes(numbers, cell.methods.size());
    for (auto& pair : pairs)
      pair.difference.add(outcomes[pair.a].metric(rule.metric) -
                          outcomes[pair.b].metric(rule.metric));
  });
  const auto counts = looks_up_to(rule, count);
  const double tail =
      normal_tail(sequential_bounds(counts, 0.05 / static_cast<double>(pairs.size())).back());
  std::string reason;
  for (const auto& [a, b, d] : pairs) {
    if (d.count < 2.0) return std::nullopt;
    const auto [low, high] = skewed_mean_interval(d, tail);
    const bool equal = -rule.margin <= low && high <= rule.margin;
    if (!equal && low <= 0.0 && high >= 0.0) return std::nullopt;
    const auto gap =
        d.mean < 0.0 ? with_interval(-d.mean, -high, -low) : with_interval(d.mean, low, high);
    reason +=
        fmt::format("{}{} {} {} by {} {} in {}", reason.empty() ? "" : "; ", cell.methods[a].id,
                    equal          ? "equals"
                    : d.mean < 0.0 ? "is below"
                                   : "is above",
                    cell.methods[b].id, gap, std::string(metric_types()[rule.metric].unit),
                    metric_types()[rule.metric].id);
  }
  return reason;
}

}  // namespace

std::optional<std::string> stop_reason(const Cell& cell, std::uint32_t count,
                                       const OutcomeSource& trials) {
  if (!cell.stop) return std::nullopt;
  return cell.stop->half_width_below > 0.0 ? narrow_enough(cell, trials)
                                           : told_apart(cell, count, trials);
}

double comparisons_of_looks(const Cell& cell, std::size_t trials) {
  if (!cell.stop || cell.stop->half_width_below > 0.0 || trials == 0) return 1.0;
  const auto counts = looks_up_to(*cell.stop, static_cast<std::uint32_t>(trials));
  return 0.025 / normal_tail(sequential_bounds(counts, 0.05).back());
}

}  // namespace gyrostat
