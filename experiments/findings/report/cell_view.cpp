#include <gyrostat/experiments/findings/report/cell_view.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/experiments/study/address.hpp>

namespace gyrostat {
namespace {

/// Whether values of more than a decade, all above 0, ask for a logarithmic axis.
bool spans_decades(const CellValues& all) {
  double low = INFINITY, high = 0.0;
  for (const auto& values : all.values)
    for (const double v : values)
      low = std::min(low, std::isnan(v) ? low : v), high = std::max(high, v);
  return low > 0.0 && high > 10.0 * low;
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

std::vector<double> sorted(std::vector<double> values) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  std::sort(values.begin(), values.end());
  return values;
}

PictureAxis metric_axis(const CellValues& all) {
  return {all.title, all.unit, spans_decades(all), {}};
}

}  // namespace gyrostat
