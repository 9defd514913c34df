#include <cmath>

#include <gyrostat/experiments/findings/report/cell_pictures.hpp>

namespace gyrostat {

Picture consistency_picture(const CellView& v) {
  Picture picture{.id = v.id + "-consistency",
                  .title = "Does a filter know how wrong it is?",
                  .x = {"normalised squared error", "1", true}};
  Mark nis, nees, one;
  nis.kind = nees.kind = Mark::Kind::points;
  nis.name = "NIS (innovations)", nees.name = "NEES (estimates)";
  nis.colour = "m0", nees.colour = "m1";
  nees.dashed = true;
  for (const std::size_t m : v.order) {
    const auto row = static_cast<double>(picture.y.names.size());
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
    if (any) picture.y.names.push_back(v.cell.methods[m].id);
  }
  one.colour = "ink";
  one.dashed = true;
  one.x = {1.0, 1.0}, one.y = {-0.5, static_cast<double>(picture.y.names.size()) - 0.5};
  for (auto* mark : {&one, &nis, &nees})
    if (!mark->x.empty()) picture.marks.push_back(std::move(*mark));
  picture.note =
      "Mean over trials with its 95 % interval. 1 (dashed): the stated covariance is true; to the "
      "right the filter is "
      "surer than it should be, to the left it is too careful.";
  return picture;
}

Picture speed_picture(const CellView& v, const std::map<std::string, double>& nanoseconds) {
  Picture picture{.id = v.id + "-speed",
                  .title = "Speed and accuracy",
                  .x = {"time per step", "ns", true},
                  .y = {"mean, " + v.values.title, v.values.unit}};
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
    picture.marks.push_back(std::move(dot));
  }
  picture.y.logarithmic = low > 0.0 && high > 10.0 * low;
  picture.note =
      "Lower and further left is better. Times were measured by the run itself, metrics included, "
      "on its machine: they "
      "are from its log and differ from run to run.";
  return picture;
}

}  // namespace gyrostat
