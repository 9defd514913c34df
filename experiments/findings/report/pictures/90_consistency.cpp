#include <tuple>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_consistency(const PictureSources& from) {
  const auto& v = from.view;
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

}  // namespace gyrostat
