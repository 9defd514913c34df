#pragma once

#include <optional>
#include <vector>

#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/findings/report/cell_values.hpp>
#include <gyrostat/experiments/findings/report/failure_view.hpp>
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
  std::vector<std::size_t> order;        ///< methods, best first
  std::string id;                        ///< begins the pictures' own
  std::optional<FailureView> failure{};  ///< where the cell asks for one

  std::string address(std::size_t place, std::size_t method) const;
  /// Whether a method is among the `count` best that do compensate, which is what pictures show at
  /// first.
  bool leads(std::size_t method, std::size_t count) const;
};

/// The values that there are, in order.
std::vector<double> sorted(std::vector<double> values);

/// An axis of the metric, logarithmic where its values are of more than a decade, all above 0.
PictureAxis metric_axis(const CellValues& all);

}  // namespace gyrostat
