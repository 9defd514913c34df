#pragma once

#include <vector>

#include <gyrostat/analysis/sensitivity/chaos.hpp>
#include <gyrostat/analysis/sensitivity/crossed_rows.hpp>
#include <gyrostat/analysis/sensitivity/outputs.hpp>

namespace gyrostat {

/// A chaos in place of the function whose outputs are known at the points of `saltelli_rows`, and
/// what is known of that function with its help.
struct Surrogate {
  /// Of the expected value over trials, fitted to all points.
  Chaos chaos{};
  /// Mean square of what chaoses fitted to the other rows miss at a row's points, the trial noise
  /// taken out, as a share of the variance.
  Estimate unexplained{};
  /// Whether `unexplained` is below `most_unexplained`, with its interval where it has one.
  bool is_trusted = false;
  /// As `sobol_indices` has them: those with the chaos where it is trusted, else those of the rows
  /// alone.
  std::vector<SobolIndex> indices{};

  static constexpr double most_unexplained = 0.1;
};

/// Sobol' indices with a surrogate that need not be right: with s the chaos, r = f - s what it
/// misses, s_i the terms of x_i alone and s_Ti all terms with x_i,
///   V   = V(s)    + 2 E r s    + E r^2               - (E r)^2
///   V_i = V(s_i)  + 2 E r s_i  + E r(B) r(AB_i)      - (E r)^2
///   VT_i = V(s_Ti) + 2 E r s_Ti + E (r(A) - r(AB_i))^2 / 2
/// holds for any s: the first terms are exact, the means of the second are over all points of a
/// row, and squares and products are those of different trials, as in `sobol_indices`, which s = 0
/// makes of it. So what s explains has no sampling error (a control variate; Owen, Monte Carlo
/// theory, methods and examples, 2013, ch. 8), what it does not is estimated without bias, and rows
/// are resampled as ever. Each row meets a chaos fitted without it, of ten parts of the rows. What
/// a chaos misses is large at few points, of which few rows tell little: an interval is wider by
/// half of `unexplained` either way.
/// `levels` by parameter, as in Chaos.
Surrogate surrogate_of(const Points& points, const std::vector<std::size_t>& levels,
                       const Outputs& outputs, Resampler& resampler);

}  // namespace gyrostat
