#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/json_object.hpp"

namespace gyrostat {

struct Cell;

/// When a cell has seen enough, "stop" in a study: once the 95 % interval of a metric's mean is
/// narrow enough for each of some methods, or once some methods are told apart. It is asked at
/// fixed numbers of trials alone (`look_counts`), of exactly so many, in their order: the answer
/// depends on nothing else.
struct StopRule {
  std::size_t metric = 0;            ///< index into Metrics
  std::vector<std::size_t> methods;  ///< of the cell
  std::uint32_t at_least = 100;      ///< trials at the first look
  double half_width_below = 0.0;     ///< of each method's mean; 0: tell the methods apart instead
  double margin = 0.0;               ///< methods that differ by less count as equal
};

/// `object` is the "stop" of `cell`, whose methods are known. Throws InputError.
StopRule read_stop(JsonObject object, const Cell& cell);

/// The file's study with `text`, which is JSON or "none", as the "stop" of every cell.
Json with_stop(Json study, const std::string& text);

/// Hands the outcomes of a cell's trials to `visit`, in order.
using OutcomeSource =
    std::function<void(const std::function<void(std::span<const double>)>& visit)>;

/// Why the rule of `cell` stops after these trials, of which there are `count`, a look; nothing
/// where it does not. A narrow interval is that of the tables: its width says little of where the
/// mean is (Chow and Robbins, Ann. Math. Stat. 36, 1965). Methods are told apart by intervals that
/// hold at all looks and for all pairs together (`sequential_bounds`).
std::optional<std::string> stop_reason(const Cell& cell, std::uint32_t count,
                                       const OutcomeSource& trials);

/// By how many comparisons an interval must be widened (Bonferroni) where a rule that tells methods
/// apart has looked at the results up to `trials`; 1 where none has.
double comparisons_of_looks(const Cell& cell, std::size_t trials);

}  // namespace gyrostat
