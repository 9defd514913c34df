#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/findings/report/design_pictures.hpp>
#include <gyrostat/results/pictures/colours.hpp>

namespace gyrostat {
namespace {

std::size_t place_of(const std::vector<std::string>& levels, const std::string& level) {
  return static_cast<std::size_t>(std::find(levels.begin(), levels.end(), level) - levels.begin());
}

bool numeric(const std::vector<std::string>& levels) {
  return std::all_of(levels.begin(), levels.end(), [](const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return end != text.c_str() && *end == '\0';
  });
}

/// Whether numbers above 0 span more than a decade.
bool decades(double low, double high) { return low > 0.0 && high > 10.0 * low; }

const Summary& judged(const Study& study, const std::vector<CellSummary>& summaries,
                      std::size_t cell, std::size_t method) {
  return summaries[cell].of(method, judging_metric(study.cells[cell]));
}

Picture lines(const Study& study, const Sweep& sweep, const std::vector<CellSummary>& summaries,
              const MethodColours& colours, const std::string& id) {
  const auto levels = sweep.levels(0);
  const bool numbers = numeric(levels);
  const std::string metric(judging_metric(study.cells[sweep.cells[0]]));
  Picture picture{.id = id + "-sweep",
                  .title = fmt::format("Error over {}", sweep.parameters[0]),
                  .note = "Mean over trials with its 95 % interval.",
                  .x = {sweep.parameters[0]},
                  .y = {fmt::format("mean {}", metric),
                        std::string(metric_types().named(metric, "report").unit),
                        false,
                        {}}};
  if (!numbers)
    picture.x.names = levels;
  else
    picture.x.logarithmic = decades(std::stod(levels.front()), std::stod(levels.back()));
  const auto& methods = study.cells[sweep.cells[0]].methods;
  double low = INFINITY, high = 0.0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    auto line = colours.mark(numbers ? Mark::Kind::line : Mark::Kind::points, methods[m].id);
    for (const auto& level : levels)
      for (std::size_t k = 0; k < sweep.cells.size(); ++k) {
        if (sweep.values[k][0] != level) continue;
        const auto& s = judged(study, summaries, sweep.cells[k], m);
        line.x.push_back(numbers ? std::stod(level) : static_cast<double>(place_of(levels, level)));
        line.y.push_back(s.mean);
        line.y_low.push_back(s.mean - s.half_width_95);
        line.y_high.push_back(s.mean + s.half_width_95);
        low = std::isnan(s.mean) ? low : std::min(low, s.mean), high = std::max(high, s.mean);
      }
    picture.marks.push_back(std::move(line));
  }
  picture.y.logarithmic = decades(low, high);
  return picture;
}

/// The two parameters of a map, and where each of its cells stands.
struct Plane {
  std::vector<std::string> across, down;
  std::vector<std::array<double, 2>> at;  ///< by cell of the map
  std::vector<std::size_t> cells;         ///< of the study
  std::string others;                     ///< "c = 1" where further parameters are held
};

Plane plane_of(const Sweep& sweep) {
  Plane plane{sweep.levels(0), sweep.levels(1), {}, {}, ""};
  std::reverse(plane.down.begin(), plane.down.end());  // large numbers on top
  for (std::size_t p = 2; p < sweep.parameters.size(); ++p)
    plane.others += fmt::format("{}{} = {}", plane.others.empty() ? "" : ", ", sweep.parameters[p],
                                sweep.levels(p).front());
  for (std::size_t k = 0; k < sweep.cells.size(); ++k) {
    bool here = true;
    for (std::size_t p = 2; p < sweep.parameters.size(); ++p)
      here = here && sweep.values[k][p] == sweep.levels(p).front();
    if (!here) continue;
    plane.cells.push_back(sweep.cells[k]);
    plane.at.push_back({static_cast<double>(place_of(plane.across, sweep.values[k][0])),
                        static_cast<double>(place_of(plane.down, sweep.values[k][1]))});
  }
  return plane;
}

Picture map_picture(const std::string& id, const std::string& title, const Sweep& sweep,
                    const Plane& plane) {
  return {.id = id,
          .title = title,
          .note = plane.others.empty() ? "" : "At " + plane.others + ". ",
          .x = {sweep.parameters[0], "", false, plane.across},
          .y = {sweep.parameters[1], "", false, plane.down}};
}

void add(Mark& mark, const std::array<double, 2>& at, const std::string& label,
         const std::string& fill) {
  mark.x.push_back(at[0]);
  mark.y.push_back(at[1]);
  mark.labels.push_back(label);
  mark.fills.push_back(fill);
}

Picture heat(const Study& study, const Sweep& sweep, const Plane& plane,
             const std::vector<CellSummary>& summaries, const MethodColours& colours,
             const std::string& id) {
  auto picture =
      map_picture(id + "-heat",
                  fmt::format("Mean {} of one method", judging_metric(study.cells[plane.cells[0]])),
                  sweep, plane);
  picture.exclusive = true;
  const auto& methods = study.cells[plane.cells[0]].methods;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (const auto c : plane.cells)
      if (const double v = judged(study, summaries, c, m).mean; std::isfinite(v))
        low = std::min(low, v), high = std::max(high, v);
  const bool log = decades(low, high);
  const auto share = [&](double v) {
    if (!(high > low)) return 0.5;
    return log ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
  };
  const std::size_t best = summaries[plane.cells[0]].best;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    auto cells = colours.mark(Mark::Kind::cells, methods[m].id);
    cells.shown = m == best;
    for (std::size_t k = 0; k < plane.cells.size(); ++k) {
      const double v = judged(study, summaries, plane.cells[k], m).mean;
      add(cells, plane.at[k], std::isnan(v) ? "–" : fmt::format("{:.3g}", v), ramp(share(v)));
    }
    picture.marks.push_back(std::move(cells));
  }
  picture.note += fmt::format(
      "One scale of colours for all methods: {:.3g} dark to {:.3g} bright{}. Choose the method in "
      "the legend.",
      low, high, log ? ", logarithmic" : "");
  return picture;
}

/// Whether any other method but the oracle cannot be told from the best of a cell.
bool is_tied(const Cell& cell, const CellSummary& summary) {
  for (std::size_t m = 0; m < cell.methods.size(); ++m)
    if (m != summary.best && !cell.methods[m].role().is_bound() &&
        !summary.methods[m].difference.separable && summary.methods[m].difference.count > 0)
      return true;
  return false;
}

Picture winners(const Study& study, const Sweep& sweep, const Plane& plane,
                const std::vector<CellSummary>& summaries, const MethodColours& colours,
                const std::string& id) {
  auto picture = map_picture(id + "-winners", "Which method wins where", sweep, plane);
  const auto& methods = study.cells[plane.cells[0]].methods;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    auto cells = colours.mark(Mark::Kind::cells, methods[m].id);
    cells.dashed = false;
    for (std::size_t k = 0; k < plane.cells.size(); ++k) {
      const auto& cell = study.cells[plane.cells[k]];
      const auto& summary = summaries[plane.cells[k]];
      if (summary.best == m && summary.finished > 0)
        add(cells, plane.at[k], methods[m].id + (is_tied(cell, summary) ? " ≈" : ""), cells.colour);
    }
    if (!cells.x.empty()) picture.marks.push_back(std::move(cells));
  }
  picture.note +=
      "The least mean of the judging metric, the oracle left out; ≈: some other method is not "
      "separable from it "
      "(paired, 95 % simultaneous over the cell's pairs).";
  return picture;
}

}  // namespace

std::vector<Picture> sweep_pictures(const Study& study, const Sweep& sweep,
                                    const std::vector<CellSummary>& summaries,
                                    const MethodColours& colours, const std::string& id) {
  if (sweep.parameters.size() == 1) return {lines(study, sweep, summaries, colours, id)};
  const auto plane = plane_of(sweep);
  if (2 * plane.cells.size() < plane.across.size() * plane.down.size()) return {};
  return {winners(study, sweep, plane, summaries, colours, id),
          heat(study, sweep, plane, summaries, colours, id)};
}

}  // namespace gyrostat
