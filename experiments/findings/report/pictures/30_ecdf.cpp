#include <algorithm>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_ecdf(const PictureSources& from) {
  const auto& v = from.view;
  Picture picture{.id = v.id + "-ecdf",
                  .title = "Share of trials below an error",
                  .x = metric_axis(v.values),
                  .y = {"share of trials"}};
  for (const std::size_t m : v.order) {
    const auto values = sorted(v.values.values[m]);
    if (values.empty()) continue;
    auto line = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    line.stepped = true;
    const double n = static_cast<double>(values.size());
    // Every trial, or 200 places and the tail beyond the last of them.
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i < next && values.size() - i > 12) continue;
      line.x.push_back(values[i]);
      line.y.push_back((static_cast<double>(i) + 1.0) / n);
      next = i + std::max<std::size_t>(1, values.size() / 200);
    }
    picture.marks.push_back(std::move(line));
  }
  picture.note =
      "Higher and further left is better: a curve above all others is of a method that is better "
      "in "
      "every quantile. The right end is the worst trial.";
  return picture;
}

}  // namespace gyrostat
