#include <cmath>

#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_convergence(const PictureSources& from) {
  const auto& v = from.view;
  Picture picture{.id = v.id + "-convergence",
                  .title = "Convergence over trials",
                  .x = {"trials", "", true},
                  .y = {"mean, " + v.values.title, v.values.unit}};
  for (const std::size_t m : v.order) {
    auto line = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    line.shown = v.leads(m, 3);
    // The first few trials would fill the picture with their wide intervals.
    Running running;
    double next = v.values.trials.size() > 40 ? 10.0 : 2.0;
    const auto note = [&] {
      const double half = half_width_95(running);
      line.x.push_back(running.count);
      line.y.push_back(running.mean);
      line.y_low.push_back(running.mean - half);
      line.y_high.push_back(running.mean + half);
    };
    for (const double x : v.values.values[m]) {
      if (std::isnan(x)) continue;
      running.add(x);
      if (running.count >= next) note(), next = std::ceil(1.12 * running.count);
    }
    if (running.count >= 2.0 && line.x.back() != running.count) note();
    if (!line.x.empty()) picture.marks.push_back(std::move(line));
  }
  picture.note =
      "Running mean with its 95 % interval at that number of trials. Each interval holds for one "
      "look, not for "
      "stopping as soon as it pleases. Choose methods in the legend.";
  return picture;
}

}  // namespace gyrostat
