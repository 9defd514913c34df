#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_heading(const PictureSources& from) {
  const auto& v = from.view;
  const auto& r = from.replayed;
  if (r.trials == 0) return {};
  Picture picture{.id = v.id + "-heading",
                  .title = "Heading error over time",
                  .x = {"time", "s"},
                  .y = {"heading error, RMS over trials", "deg"}};
  double least = INFINITY, most = 0.0;
  for (const std::size_t m : v.order) {
    auto line = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    line.x = r.t_s;
    line.y = r.methods[m].heading_rms;
    if (!line.y.empty())
      least = std::min(least, line.y.back()), most = std::max(most, line.y.back());
    picture.marks.push_back(std::move(line));
  }
  picture.y.logarithmic = least > 0.0 && most > 20.0 * least;
  picture.note = fmt::format(
      "Integral of the compensated rate error from the start, root of the mean square over {} "
      "trials "
      "simulated again. An estimate that follows the white noise makes it small without knowing "
      "the bias.",
      r.trials);
  return picture;
}

}  // namespace gyrostat
