#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/analysis/sensitivity/designs.hpp>
#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

struct Cell;

enum class DesignKind {
  grid,
  list,
  latin_hypercube,
  sobol,
  one_at_a_time,
  morris,
  saltelli,
  surrogate
};
inline constexpr std::array all_design_kinds = {
    DesignKind::grid,     DesignKind::list,          DesignKind::latin_hypercube,
    DesignKind::sobol,    DesignKind::one_at_a_time, DesignKind::morris,
    DesignKind::saltelli, DesignKind::surrogate};

/// A parameter that a design varies.
struct DesignParameter {
  std::string path{};  ///< in the cell's JSON
  std::string name{};  ///< as tables call it: as much of the path's end as is unique in the design
  std::string unit{};
  Range range{};
  double from = no_value, to = no_value;  ///< NaN where the design lists its values
  bool logarithmic = false;

  /// The value at a coordinate of the unit cube; whole numbers where the parameter is one.
  double at(double coordinate) const;
  /// The coordinate of a value.
  double coordinate(double value) const;
  /// How many values it takes between its ends, each as likely; 0 where it is continuous.
  std::size_t level_count() const;
};

/// Many cells from one: the points of a design over parameters of a cell.
struct Design {
  std::string name{};  ///< of the cell that stands in the study
  DesignKind kind = DesignKind::grid;
  std::vector<DesignParameter> parameters{};
  /// By point, by parameter, as JSON; empty where the point leaves the cell's own.
  std::vector<std::vector<std::string>> values{};
  std::vector<std::string> labels{};  ///< by point: what it is in the design
  Points points{};                    ///< in the unit cube; none of a grid or a list
  std::vector<double> base{};         ///< values at the base of one_at_a_time
  std::size_t levels = 0;             ///< of morris
  std::size_t first_cell = 0;         ///< where its points begin among the study's cells

  std::string cell_name(std::size_t point) const { return name + "[" + labels[point] + "]"; }
  /// Whether its points serve the design alone, too many or too artificial for tables of their own.
  bool is_sampled() const;
};

/// The kind's name in a study file.
std::string name_of(DesignKind kind);

/// A cell with a "grid": {"path": [values], …} as a design of that kind: one point for each
/// combination.
Design read_grid(const Json& cell, const std::string& place, Mistakes* mistakes = nullptr);

/// A cell's "design". `base` is the cell without it, read; `seed` is the study's. InputErrors name
/// path, value, unit, range and the nearest name; where they are gathered in `mistakes`, a design
/// with any has no values.
Design read_design(const Json& cell, const Cell& base, std::uint64_t seed, const std::string& place,
                   Mistakes* mistakes = nullptr);

/// The cells of a design, as JSON, with the places that mistakes in them are reported at.
std::vector<std::pair<Json, std::string>> cells_of(const Design& design, const Json& cell,
                                                   const std::string& place);

}  // namespace gyrostat
