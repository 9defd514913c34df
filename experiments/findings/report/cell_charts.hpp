#pragma once

#include <map>
#include <vector>

#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/findings/report/cell_values.hpp>
#include <gyrostat/experiments/findings/report/method_colours.hpp>
#include <gyrostat/experiments/findings/report/replayed.hpp>

namespace gyrostat {

/// What the pictures of one cell are drawn from.
struct CellView {
  const Study& study;
  const Cell& cell;
  const MethodColours& colours;
  const CellSummary& summary;
  const CellValues& values;
  std::vector<std::size_t> order;  ///< methods, best first
  std::string id;                  ///< begins the charts' own

  std::string address(std::size_t place, std::size_t method) const;
  /// Whether a method is among the `count` best that do compensate, which is what pictures show at
  /// first.
  bool leads(std::size_t method, std::size_t count) const;
};

Chart box_chart(const CellView& view);
Chart ecdf_chart(const CellView& view);
Chart convergence_chart(const CellView& view);
Chart rank_chart(const CellView& view, const CellRanking& ranking);
Chart consistency_chart(const CellView& view);
Chart speed_chart(const CellView& view, const std::map<std::string, double>& nanoseconds);
Chart allan_chart(const CellView& view, const Replayed& replayed);
Chart error_chart(const CellView& view, const Replayed& replayed);
Chart heading_chart(const CellView& view, const Replayed& replayed);

}  // namespace gyrostat
