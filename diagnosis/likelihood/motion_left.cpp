#include <gyrostat/diagnosis/likelihood/motion_left.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/explained.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::ptrdiff_t rate_reach = 4;  ///< samples of the rate before and after
constexpr std::size_t taps = 2 * rate_reach + 1;
constexpr std::array levels = {0.02, 0.1, 0.25, 0.4, 0.6, 0.75, 0.9, 0.98};
constexpr std::size_t regressor_columns = taps + levels.size() + 1;

}  // namespace

double log_gain_of_motion(const Conditions& conditions, const std::vector<double>& left_dps) {
  const auto& rate = conditions.series().rate_ref_dps;
  if (rate.empty() || !conditions.has_motion()) return 0.0;
  // Of the curve, bends at quantiles of the rate.
  std::vector<double> there;
  for (const double r : rate)
    if (!is_missing(r)) there.push_back(r);
  std::array<double, levels.size()> bends{};
  for (std::size_t k = 0; k < levels.size(); ++k) bends[k] = quantile(there, levels[k]);

  Explained explained(regressor_columns);
  Eigen::VectorXd row(regressor_columns);
  for (const auto& span : conditions.spans(Part::train))
    for (auto i = static_cast<std::ptrdiff_t>(span.first) + rate_reach;
         i + rate_reach < static_cast<std::ptrdiff_t>(span.last); ++i) {
      const auto at = [&](std::ptrdiff_t k) { return rate[static_cast<std::size_t>(k)]; };
      const double value = left_dps[static_cast<std::size_t>(i)];
      if (is_missing(value) || is_missing(at(i - rate_reach)) || is_missing(at(i + rate_reach)))
        continue;
      for (std::ptrdiff_t lag = -rate_reach; lag <= rate_reach; ++lag)
        row[lag + rate_reach] = at(i + lag);
      for (std::size_t k = 0; k < bends.size(); ++k)
        row[static_cast<Eigen::Index>(taps + k)] = std::max(0.0, at(i) - bends[k]);
      row[regressor_columns - 1] = 1.0;
      if (!row.allFinite()) continue;
      explained.add(row, value);
    }
  return explained.log_gain();
}

}  // namespace gyrostat::gap
