#include <algorithm>
#include <cmath>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_speed(const PictureSources& from) {
  const auto& v = from.view;
  Picture picture{.id = v.id + "-speed",
                  .title = "Speed and accuracy",
                  .x = {"time per step", "ns", true},
                  .y = {"mean, " + v.values.title, v.values.unit}};
  double low = INFINITY, high = 0.0;
  for (const std::size_t m : v.order) {
    const auto& name = v.cell.methods[m].id;
    const auto& s = v.summary.of(m, v.values.metric);
    const auto time = from.nanoseconds.find(name);
    if (time == from.nanoseconds.end() || std::isnan(s.mean)) continue;
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
