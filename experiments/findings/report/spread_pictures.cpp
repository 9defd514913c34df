#include <algorithm>
#include <cmath>

#include <gyrostat/experiments/findings/report/cell_pictures.hpp>
#include <gyrostat/experiments/study/address.hpp>

namespace gyrostat {
namespace {

std::vector<double> sorted(std::vector<double> values) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  std::sort(values.begin(), values.end());
  return values;
}

double quantile(const std::vector<double>& values, double share) {
  const double at = share * static_cast<double>(values.size() - 1);
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= values.size()) return values.back();
  return values[k] + (at - static_cast<double>(k)) * (values[k + 1] - values[k]);
}

/// Whether values of more than a decade, all above 0, ask for a logarithmic axis.
bool spans_decades(const CellValues& all) {
  double low = INFINITY, high = 0.0;
  for (const auto& values : all.values)
    for (const double v : values)
      low = std::min(low, std::isnan(v) ? low : v), high = std::max(high, v);
  return low > 0.0 && high > 10.0 * low;
}

PictureAxis metric_axis(const CellValues& all) {
  return {all.title, all.unit, spans_decades(all), {}};
}

}  // namespace

std::string CellView::address(std::size_t place, std::size_t method) const {
  return address_text(study.name(), cell.name, values.trials[place], cell.methods[method].id);
}

bool CellView::leads(std::size_t method, std::size_t count) const {
  for (const std::size_t m : order) {
    if (!cell.methods[m].role().is_contender()) continue;
    if (m == method) return true;
    if (--count == 0) break;
  }
  return false;
}

Picture box_picture(const CellView& v) {
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

Picture ecdf_picture(const CellView& v) {
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

Picture convergence_picture(const CellView& v) {
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
