#include <cmath>

#include <gyrostat/experiments/findings/report/cell_charts.hpp>

namespace gyrostat {

Chart rank_chart(const CellView& v, const CellRanking& ranking) {
  Chart chart{.id = v.id + "-ranks",
              .title = "Critical differences",
              .note = {},
              .x = {"mean rank over trials (1 is best)", "", false, {}},
              .y = {},
              .marks = {}};
  const auto& methods = ranking.methods;
  for (const auto& group : ranking.not_separable) {
    if (group.size() < 2) continue;
    Mark link;
    link.colour = "soft";
    for (const std::size_t i : group)
      link.x.push_back(methods[i].mean_rank), link.y.push_back(static_cast<double>(i));
    chart.marks.push_back(std::move(link));
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    chart.y.names.push_back(methods[i].method);
    if (std::isnan(methods[i].mean_rank)) continue;
    auto dot = v.colours.mark(Mark::Kind::points, methods[i].method);
    const double half = 0.5 * ranking.critical_difference;
    dot.x = {methods[i].mean_rank}, dot.y = {static_cast<double>(i)};
    if (half >= 0.0) dot.x_low = {dot.x[0] - half}, dot.x_high = {dot.x[0] + half};
    chart.marks.push_back(std::move(dot));
  }
  chart.note = fmt::format(
      "By {}, over {} trials, each method ranked in each trial. A grey line links methods that are "
      "not "
      "separable.",
      ranking.metric, ranking.trials);
  if (ranking.critical_difference >= 0.0)
    chart.note += fmt::format(
        " Whiskers: half the critical difference ({:.3g}, Nemenyi), so methods whose whiskers do "
        "not "
        "overlap differ in rank.",
        ranking.critical_difference);
  return chart;
}

Chart consistency_chart(const CellView& v) {
  Chart chart{.id = v.id + "-consistency",
              .title = "Does a filter know how wrong it is?",
              .note = {},
              .x = {"normalised squared error", "1", true, {}},
              .y = {},
              .marks = {}};
  Mark nis, nees, one;
  nis.kind = nees.kind = Mark::Kind::points;
  nis.name = "NIS (innovations)", nees.name = "NEES (estimates)";
  nis.colour = "m0", nees.colour = "m1";
  nees.dashed = true;
  for (const std::size_t m : v.order) {
    const auto row = static_cast<double>(chart.y.names.size());
    bool any = false;
    for (const auto& [metric, mark, shift] :
         {std::tuple("nis", &nis, -0.12), std::tuple("nees", &nees, 0.12)}) {
      const auto& s = v.summary.of(m, metric);
      if (!(s.mean > 0.0)) continue;
      any = true;
      mark->x.push_back(s.mean);
      mark->y.push_back(row + shift);
      mark->x_low.push_back(s.mean - s.half_width_95);
      mark->x_high.push_back(s.mean + s.half_width_95);
      mark->labels.push_back(v.cell.methods[m].id);
    }
    if (any) chart.y.names.push_back(v.cell.methods[m].id);
  }
  one.colour = "ink";
  one.dashed = true;
  one.x = {1.0, 1.0}, one.y = {-0.5, static_cast<double>(chart.y.names.size()) - 0.5};
  for (auto* mark : {&one, &nis, &nees})
    if (!mark->x.empty()) chart.marks.push_back(std::move(*mark));
  chart.note =
      "Mean over trials with its 95 % interval. 1 (dashed): the stated covariance is true; to the "
      "right the filter is "
      "surer than it should be, to the left it is too careful.";
  return chart;
}

Chart speed_chart(const CellView& v, const std::map<std::string, double>& nanoseconds) {
  Chart chart{.id = v.id + "-speed",
              .title = "Speed and accuracy",
              .note = {},
              .x = {"time per step", "ns", true, {}},
              .y = {"mean, " + v.values.title, v.values.unit, false, {}},
              .marks = {}};
  double low = INFINITY, high = 0.0;
  for (const std::size_t m : v.order) {
    const auto& name = v.cell.methods[m].id;
    const auto& s = v.summary.of(m, v.values.metric);
    const auto time = nanoseconds.find(name);
    if (time == nanoseconds.end() || std::isnan(s.mean)) continue;
    auto dot = v.colours.mark(Mark::Kind::points, name);
    dot.labelled = true;
    dot.x = {time->second}, dot.y = {s.mean};
    dot.y_low = {s.mean - s.half_width_95}, dot.y_high = {s.mean + s.half_width_95};
    dot.labels = {name};
    low = std::min(low, s.mean), high = std::max(high, s.mean);
    chart.marks.push_back(std::move(dot));
  }
  chart.y.logarithmic = low > 0.0 && high > 10.0 * low;
  chart.note =
      "Lower and further left is better. Times were measured by the run itself, metrics included, "
      "on its machine: they "
      "are from its log and differ from run to run.";
  return chart;
}

}  // namespace gyrostat
