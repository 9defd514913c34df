#include <gyrostat/diagnosis/likelihood/heading_left.hpp>

#include <cmath>
#include <numbers>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/explained.hpp>
#include <gyrostat/diagnosis/likelihood/walking_level.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::ptrdiff_t reach_of_rates = 4;  ///< samples of the rate before and after
constexpr std::size_t rates_beside = 2 * reach_of_rates + 1, harmonics = 3;
constexpr std::size_t count_of_columns = rates_beside + 2 * harmonics;

}  // namespace

double log_gain_of_turning(const Conditions& conditions, const std::vector<double>& errors_deg,
                           double level_gain, double share) {
  const auto& rate = conditions.series().rate_ref_dps;
  const auto& turned = conditions.turned_deg();
  if (rate.empty() || !conditions.has_motion()) return 0.0;
  Explained explained(count_of_columns);
  Eigen::VectorXd row(count_of_columns);
  const WalkingLevel level(level_gain);
  WalkingLevel of_errors = level;
  std::vector<WalkingLevel> of_columns(count_of_columns, level);
  for (const auto& span : conditions.spans(Part::train))
    for (auto i = static_cast<std::ptrdiff_t>(span.first) + reach_of_rates;
         i + reach_of_rates < static_cast<std::ptrdiff_t>(span.last); ++i) {
      const auto here = static_cast<std::size_t>(i);
      if (is_missing(errors_deg[here])) continue;
      for (std::ptrdiff_t lag = -reach_of_rates; lag <= reach_of_rates; ++lag)
        row[lag + reach_of_rates] = rate[static_cast<std::size_t>(i + lag)];
      const double angle = turned[here] * std::numbers::pi / 180.0;
      for (std::size_t k = 0; k < harmonics; ++k) {
        const auto at = static_cast<Eigen::Index>(rates_beside + 2 * k);
        row[at] = std::sin(static_cast<double>(k + 1) * angle);
        row[at + 1] = std::cos(static_cast<double>(k + 1) * angle);
      }
      if (!row.allFinite()) continue;
      for (std::size_t c = 0; c < count_of_columns; ++c) {
        auto& value = row[static_cast<Eigen::Index>(c)];
        value = of_columns[c].innovation(value);
      }
      const double error = of_errors.innovation(errors_deg[here]);
      explained.add(row, error);
    }
  return explained.log_gain(share);
}

}  // namespace gyrostat::gap
