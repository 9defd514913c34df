#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

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
