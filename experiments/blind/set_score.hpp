#pragma once

#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/blind/blind_answer.hpp>

namespace gyrostat::gap {

/// A recording with what was said of it, own effects left out.
struct Scored {
  BlindLabel label;
  BlindAnswer answer;
};

/// By scenario, number of effects and strength: recall, precision, exact sets, gap closed.
Table set_table(const std::string& title, const std::vector<Scored>& all);
/// By effect: how often it is named where it is with others, and named where it is not.
Table set_effects_table(const std::string& title, const std::vector<Scored>& all);
/// Whether inclusion probabilities are what they say, and their Brier scores.
Table inclusion_table(const std::string& title, const std::vector<Scored>& all);
/// Whether intervals of the gap closed hold what the right set closes.
Table closed_table(const std::string& title, const std::vector<Scored>& all);

}  // namespace gyrostat::gap
