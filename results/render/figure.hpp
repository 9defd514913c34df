#pragma once

#include <string>
#include <vector>

namespace gyrostat {

/// Lines over a common axis, each with a band around it where it has one.
struct LineChart {
  struct Line {
    std::string name;
    std::vector<double> x, y;
    std::vector<double> low, high;  ///< empty: no band
  };
  std::string title, x_label, y_label;
  std::vector<Line> lines;
  bool logarithmic = false;  ///< both axes
  bool panels = false;       ///< each line in a panel of its own, all with the same axes
};

/// A number for each row and column, coloured by its ratio to the least of its row.
struct HeatMap {
  std::string title;
  std::vector<std::string> rows, columns;
  std::vector<std::vector<double>> values;
  std::vector<bool> ranked;  ///< by column: whether it counts for the least of a row
};

/// Mean ranks on a line, best at the left; a bar joins those that differ by no more than the
/// critical difference (Demsar, JMLR 7, 2006, fig. 1).
struct RankDiagram {
  struct Method {
    std::string name;
    double mean_rank;
  };
  std::string title;
  std::vector<Method> methods;
  double critical_difference;
};

/// As SVG: the same bytes for the same numbers.
std::string svg(const LineChart& chart);
std::string svg(const HeatMap& map);
std::string svg(const RankDiagram& diagram);

}  // namespace gyrostat
