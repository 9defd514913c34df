#include <gyrostat/experiments/pages/trial_tables.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/analysis/error_series.hpp>
#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/experiments/pages/played.hpp>

namespace gyrostat::tabling {
namespace {

Played played_for(const Request& request, Results& results, const Cell& cell) {
  return play(cell, results.of(cell), results.study().seed, request.trial,
              methods_of(request, cell));
}

std::vector<double> traced(const Request& request, const Played& played, std::size_t m) {
  if (request.quantity == "heading") return heading_errors_deg(played.series, played.tracks[m]);
  if (request.quantity == "estimate") return played.tracks[m].estimate_dps;
  return played.rate_errors_dps(m);
}

void add_binned(Table& table, const std::string& name, const std::string& unit, bool spread,
                const std::vector<double>& values, std::size_t points) {
  table.columns.push_back({name, unit});
  if (spread) table.columns.push_back({"std of " + name, unit});
  for (std::size_t b = 0; b < points; ++b) {
    const std::size_t from = b * values.size() / points, to = (b + 1) * values.size() / points;
    const auto moments = error_moments(to - from, [&](std::size_t i) { return values[from + i]; });
    table.rows[b].push_back(gyrostat::cell(moments.mean));
    if (spread) table.rows[b].push_back(gyrostat::cell(moments.std));
  }
}

}  // namespace

Table traces(const Request& request, Results& results) {
  const Cell& cell = *request.cells.front();
  const auto played = played_for(request, results, cell);
  const std::size_t points = std::min(request.points, played.series.size());
  Table table{.title = request.title, .columns = {}};
  table.rows.resize(points);
  const bool heading = request.quantity == "heading", rate = request.quantity == "rate";
  add_binned(table, "t", "s", false, played.series.t_s, points);
  if (!played.series.temperature_C.empty())
    add_binned(table, "temperature", "°C", false, played.series.temperature_C, points);
  if (!cell.recording && !heading) {
    std::vector<double> truth(played.series.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      truth[i] = played.series.thermal_bias_dps[i] + played.series.random_error_dps[i];
    add_binned(table, "truth", "dps", false, truth, points);
  }
  for (std::size_t m = 0; m < played.ids.size(); ++m)
    add_binned(table, played.ids[m], heading ? "deg" : "dps", rate, traced(request, played, m),
               points);
  table.notes.push_back(fmt::format("{}, trial {}: {} of each of {} intervals", cell.name,
                                    request.trial, rate ? "mean and standard deviation" : "mean",
                                    points));
  return table;
}

Table allan(const Request& request, Results& results) {
  const Cell& cell = *request.cells.front();
  const auto played = played_for(request, results, cell);
  Table table{.title = request.title, .columns = {{"tau", "s"}}};
  for (std::size_t m = 0; m < played.ids.size(); ++m) {
    const auto points =
        overlapping_allan_deviation(played.rate_errors_dps(m), played.series.rate_hz());
    table.rows.resize(points.size());
    for (const char* prefix : {"", "lower ", "upper "})
      table.columns.push_back({prefix + played.ids[m], "dps"});
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (m == 0) table.rows[p].emplace_back(points[p].tau_s);
      for (const double v : {points[p].deviation, points[p].lower, points[p].upper})
        table.rows[p].emplace_back(v);
    }
  }
  table.notes.push_back(
      fmt::format("{}, trial {}; lower and upper bound the 95 % confidence interval "
                  "by equivalent degrees of freedom",
                  cell.name, request.trial));
  return table;
}

}  // namespace gyrostat::tabling
