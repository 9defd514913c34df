#pragma once

#include <functional>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// A bounded quantity to be searched, on a logarithmic scale where its lower bound is positive, in
/// whole numbers on request.
struct SearchRange {
  double low = 0.0;
  double high = 1.0;
  bool whole = false;

  /// The value at `fraction` of the way, 0 to 1.
  double at(double fraction) const;
};

struct SearchResult {
  std::vector<double> values;
  double objective = no_value;
  int evaluations = 0;
};

/// Minimises `objective` over a box with exactly `evaluations` calls, without derivatives: the
/// first half on Halton's points, the rest by the simplex of Nelder and Mead (1965) from the best
/// of them, clipped to the box. Deterministic. NaN counts as worst.
SearchResult box_search(const std::vector<SearchRange>& ranges, int evaluations,
                        const std::function<double(const std::vector<double>&)>& objective);

}  // namespace gyrostat
