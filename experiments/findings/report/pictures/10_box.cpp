#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {
namespace {

double quantile(const std::vector<double>& values, double share) {
  const double at = share * static_cast<double>(values.size() - 1);
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= values.size()) return values.back();
  return values[k] + (at - static_cast<double>(k)) * (values[k + 1] - values[k]);
}

}  // namespace

Picture picture_box(const PictureSources& from) {
  const auto& v = from.view;
  constexpr std::size_t shown_outliers = 10;
  Picture picture{.id = v.id + "-boxes",
                  .title = "Spread over trials, and the worst of them",
                  .x = metric_axis(v.values)};
  for (std::size_t row = 0; row < v.order.size(); ++row) {
    const std::size_t m = v.order[row];
    const auto& name = v.cell.methods[m].id;
    picture.y.names.push_back(name);
    const auto values = sorted(v.values.values[m]);
    if (values.empty()) continue;
    const double y = static_cast<double>(row), q1 = quantile(values, 0.25),
                 q3 = quantile(values, 0.75);
    const double reach = 1.5 * (q3 - q1);
    auto box = v.colours.mark(Mark::Kind::boxes, name);
    box.x = {quantile(values, 0.5)}, box.y = {y}, box.x_low = {q1}, box.x_high = {q3};
    box.from = {*std::lower_bound(values.begin(), values.end(), q1 - reach)};
    box.to = {*std::prev(std::upper_bound(values.begin(), values.end(), q3 + reach))};
    auto worst = v.colours.mark(Mark::Kind::points, name);
    for (const std::size_t place : worst_trials(v.values.values[m], shown_outliers)) {
      const double value = v.values.values[m][place];
      if (value <= box.to.front()) break;
      worst.x.push_back(value);
      worst.y.push_back(y);
      worst.addresses.push_back(v.address(place, m));
    }
    picture.marks.push_back(std::move(box));
    if (!worst.x.empty()) picture.marks.push_back(std::move(worst));
  }
  picture.note = fmt::format(
      "Boxes: quartiles and median of {} trials; whiskers: the farthest trials within 1.5 box "
      "lengths; "
      "dots: trials beyond, the worst {} of each method. Choose a dot to copy the command that "
      "replays it.",
      v.values.trials.size(), shown_outliers);
  return picture;
}

}  // namespace gyrostat
