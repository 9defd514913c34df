#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_medians(const PictureSources& from) {
  const auto& v = from.view;
  Chart chart{.id = v.id + "-medians",
              .title = "Medians",
              .note = "The median of each method over all trials.",
              .x = {v.values.title, v.values.unit, false, {}},
              .y = {"", "", false, {}},
              .marks = {}};
  for (const std::size_t m : v.order) {
    auto bar = v.colours.mark(Mark::Kind::bars, v.cell.methods[m].id);
    bar.x = {v.summary.of(m, v.values.metric).median};
    bar.y = {static_cast<double>(chart.y.names.size())};
    chart.y.names.push_back(v.cell.methods[m].id);
    chart.marks.push_back(std::move(bar));
  }
  return chart;
}

}  // namespace gyrostat
