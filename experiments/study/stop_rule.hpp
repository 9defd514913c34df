#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

struct Cell;

/// When a cell has seen enough, "stop" in a study: once the 95 % interval of a metric's mean is
/// narrow enough for each of some methods, or once some methods are told apart. It is asked at
/// fixed numbers of trials alone (`look_counts`), of exactly so many, in their order: the answer
/// depends on nothing else.
struct StopRule {
  std::size_t metric = 0;            ///< index into metric_types()
  std::vector<std::size_t> methods;  ///< of the cell
  std::uint32_t at_least = 100;      ///< trials at the first look
  double half_width_below = 0.0;     ///< of each method's mean; 0: tell the methods apart instead
  double margin = 0.0;               ///< methods that differ by less count as equal
};

/// `object` is the "stop" of `cell`, whose methods are known. Throws InputError.
StopRule read_stop(JsonObject object, const Cell& cell);

/// The file's study with `text`, which is JSON or "none", as the "stop" of every cell.
Json with_stop(Json study, const std::string& text);

}  // namespace gyrostat
