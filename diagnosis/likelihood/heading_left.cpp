#include <gyrostat/diagnosis/likelihood/heading_left.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/step.hpp>
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
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count_of_columns, count_of_columns);
  Eigen::VectorXd with_errors = Eigen::VectorXd::Zero(count_of_columns), row(count_of_columns);
  double squares = 0.0, count = 0.0;
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
      products.selfadjointView<Eigen::Lower>().rankUpdate(row);
      with_errors += error * row;
      squares += error * error;
      count += 1.0;
    }
  if (count < 10.0 * count_of_columns) return 0.0;
  Eigen::MatrixXd normal = products.selfadjointView<Eigen::Lower>();
  // A motion of few frequencies has rates that are alike.
  normal.diagonal() *= 1.0 + 1e-9;
  normal.diagonal().array() += 1e-12;
  const double explained = with_errors.dot(solve_symmetric(normal, with_errors));
  const double part = std::clamp(explained / std::max(squares, 1e-300), 0.0, 1.0 - 1e-12);
  return -0.5 * share * count * std::log1p(-part) - 0.5 * static_cast<double>(count_of_columns);
}

}  // namespace gyrostat::gap
