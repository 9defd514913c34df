#pragma once

#include <functional>
#include <vector>

#include <gyrostat/analysis/search/box_search.hpp>

namespace gyrostat {

/// Minimises `objective` over a box with exactly `evaluations` calls by evolution with an adapted
/// covariance matrix, CMA-ES (Hansen, The CMA Evolution Strategy: A Tutorial, arXiv:1604.00772,
/// fig. 6 with the parameters of its table 1, active weights left out): for many dimensions whose
/// effects are correlated, where a simplex stalls. It begins in the middle of the box with a
/// deviation of 0.3 of its width; where the deviation has shrunk below 1e-4 it begins anew, with
/// twice the population (Auger and Hansen 2005), at a random point. What leaves the box is
/// reflected into it. Only the order of objectives counts, so any monotone function of one finds
/// the same. Deterministic; NaN counts as worst.
///
/// Example: the minimum of a valley.
///
///   const auto found = covariance_search({{-2, 2}, {-1, 3}}, 1000, [](const auto& x) {
///     return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
///   });
SearchResult covariance_search(const std::vector<SearchRange>& ranges, int evaluations,
                               const std::function<double(const std::vector<double>&)>& objective);

}  // namespace gyrostat
