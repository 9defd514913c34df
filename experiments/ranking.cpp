#include "experiments/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/trial.hpp"

namespace gyrostat {

CellRanking rank_cell(const Cell& cell, const TrialSource& trials) {
  const auto summary = summarise_cell(cell, trials);
  CellRanking ranking{.cell = cell.name, .metric = std::string(judging_metric(cell)), .unit = cell.recording ? "nat" : "dps",
                      .trials = summary.finished, .methods = {}, .not_separable = {}, .sentences = {}};
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& s = summary.of(m, ranking.metric);
    ranking.methods.push_back({cell.methods[m].id, s.mean, s.half_width_95, no_value, no_value, s.worst});
  }
  std::stable_sort(ranking.methods.begin(), ranking.methods.end(),
                   [](const auto& a, const auto& b) { return a.mean < b.mean; });
  if (summary.finished > 0)
    ranking.sentences = {fmt::format("{} has the least mean {}, {:.3g} {}.", cell.methods[summary.best].id, ranking.metric,
                                     summary.of(summary.best, ranking.metric).mean, ranking.unit)};
  return ranking;
}

}  // namespace gyrostat
