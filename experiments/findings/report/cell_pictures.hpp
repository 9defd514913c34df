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
  std::string id;                  ///< begins the pictures' own

  std::string address(std::size_t place, std::size_t method) const;
  /// Whether a method is among the `count` best that do compensate, which is what pictures show at
  /// first.
  bool leads(std::size_t method, std::size_t count) const;
};

Picture box_picture(const CellView& view);
Picture ecdf_picture(const CellView& view);
Picture convergence_picture(const CellView& view);
Picture consistency_picture(const CellView& view);
Picture speed_picture(const CellView& view, const std::map<std::string, double>& nanoseconds);
Picture allan_picture(const CellView& view, const Replayed& replayed);
Picture error_picture(const CellView& view, const Replayed& replayed);
Picture heading_picture(const CellView& view, const Replayed& replayed);

}  // namespace gyrostat
