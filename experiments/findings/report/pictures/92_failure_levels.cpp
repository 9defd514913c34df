#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {
namespace {

/// How likely the metric is beyond each of some thresholds, by plain trials.
void add_plain(const std::vector<double>& values, Mark line, Picture& picture) {
  constexpr double step = 1.15;
  line.dashed = true;
  const auto n = static_cast<double>(values.size());
  for (double beyond = n; beyond >= 1.0;
       beyond = std::min(beyond - 1.0, std::floor(beyond / step))) {
    line.x.push_back(values[values.size() - static_cast<std::size_t>(beyond)]);
    line.y.push_back(beyond / n);
    line.labels.push_back(fmt::format("{:g} of {:g} plain trials", beyond, n));
  }
  if (line.x.size() > 1) picture.marks.push_back(std::move(line));
}

void add_run(const SubsetSimulation& run, const FailureRule& rule, Mark line, Picture& picture) {
  double so_far = 1.0;
  for (const auto& level : run.levels()) {
    so_far *= level.share;
    if (so_far == 0.0) break;
    line.x.push_back(rule.above ? level.threshold : -level.threshold);
    line.y.push_back(so_far);
    line.labels.push_back(
        fmt::format("level {}: share {:.3g}, {} chains, acceptance {:.2f}, spread {:.2f}",
                    line.x.size(), level.share, level.chains, level.acceptance, level.spread));
  }
  if (!line.x.empty()) picture.marks.push_back(std::move(line));
}

}  // namespace

Picture picture_failure_levels(const PictureSources& from) {
  const auto& v = from.view;
  if (!v.failure) return {};
  const auto& rule = *v.cell.failure;
  const auto& metric = metric_types()[rule.metric];
  Picture picture{
      .id = v.id + "-failure-levels",
      .title = "How likely it fails, threshold by threshold",
      .x = {std::string(metric.id), std::string(metric.unit)},
      .y = {fmt::format("probability {} it", rule.above ? "above" : "below"), "", true}};
  for (std::size_t f = 0; f < v.failure->findings.size(); ++f) {
    const auto& finding = v.failure->findings[f];
    if (finding.search)
      for (const auto& run : finding.search->runs())
        add_run(run, rule, v.colours.mark(Mark::Kind::line, finding.method), picture);
    add_plain(v.failure->plain[f], v.colours.mark(Mark::Kind::line, finding.method), picture);
    if (!finding.rare) continue;
    auto told = v.colours.mark(Mark::Kind::points, finding.method);
    told.x = {rule.threshold};
    told.y = {finding.rare->probability};
    told.y_low = {finding.rare->low};
    told.y_high = {finding.rare->high};
    told.labels = {"mean of the runs, 95 %"};
    picture.marks.push_back(std::move(told));
  }
  picture.note = fmt::format(
      "A failure is {} {} {:g} {}. Dashed: the share of plain trials beyond each value, down to a "
      "single "
      "one. Solid: "
      "each run of subset simulation, a point a level; the lines' spread is what the interval at "
      "the threshold is made of.",
      metric.id, rule.above ? "above" : "below", rule.threshold, metric.unit);
  return picture;
}

}  // namespace gyrostat
