#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_errors(const PictureSources& from) {
  const auto& v = from.view;
  const auto& r = from.replayed;
  if (r.trials == 0) return {};
  Picture picture{.id = v.id + "-error",
                  .title = r.truth ? "Error of the estimate over time" : "Innovation over time",
                  .x = {"time", "s"},
                  .y = {r.truth ? "estimate − true error" : "innovation", "dps"},
                  .exclusive = true};
  for (const std::size_t m : v.order) {
    const auto& method = r.methods[m];
    auto band = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    band.shown = v.leads(m, 1);
    band.dashed = false;
    band.x = r.t_s;
    band.y = method.error_mean;
    auto upper = band;
    upper.colour = "ink";
    upper.dashed = true;
    auto lower = upper;
    for (std::size_t i = 0; i < r.t_s.size(); ++i) {
      band.y_low.push_back(method.error_mean[i] - 3.0 * method.error_std[i]);
      band.y_high.push_back(method.error_mean[i] + 3.0 * method.error_std[i]);
      upper.y[i] = 3.0 * method.stated_std[i];
      lower.y[i] = -3.0 * method.stated_std[i];
    }
    const bool states =
        std::any_of(upper.y.begin(), upper.y.end(), [](double y) { return std::isfinite(y); });
    picture.marks.push_back(std::move(band));
    if (!states) continue;
    picture.marks.push_back(std::move(upper));
    picture.marks.push_back(std::move(lower));
  }
  if (std::none_of(picture.marks.begin(), picture.marks.end(),
                   [](const Mark& m) { return m.shown; }) &&
      !picture.marks.empty())
    picture.marks.front().shown = true;
  picture.note = fmt::format(
      "Line: mean over {0} trials simulated again; band: ± 3 standard deviations over those "
      "trials; "
      "dashed: ± 3 σ as the filter itself states it. A band wider than the dashed lines is of a "
      "filter that is surer than it should be.",
      r.trials);
  return picture;
}

}  // namespace gyrostat
