#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_medians(const PictureSources& from) {
  const auto& v = from.view;
  Picture picture{.id = v.id + "-medians",
                  .title = "Medians",
                  .note = "The median of each method over all trials.",
                  .x = {v.values.title, v.values.unit, false, {}},
                  .y = {"", "", false, {}},
                  .marks = {}};
  for (const std::size_t m : v.order) {
    auto bar = v.colours.mark(Mark::Kind::bars, v.cell.methods[m].id);
    bar.x = {v.summary.of(m, v.values.metric).median};
    bar.y = {static_cast<double>(picture.y.names.size())};
    picture.y.names.push_back(v.cell.methods[m].id);
    picture.marks.push_back(std::move(bar));
  }
  return picture;
}

}  // namespace gyrostat
