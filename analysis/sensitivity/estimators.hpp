#pragma once

#include <span>
#include <vector>

#include <gyrostat/analysis/sensitivity/crossed_rows.hpp>
#include <gyrostat/analysis/sensitivity/designs.hpp>
#include <gyrostat/analysis/sensitivity/outputs.hpp>

namespace gyrostat {

/// One-at-a-time around a base: what the parameter is at the base and at its two ends; the
/// logarithms of these where its scale is logarithmic, with 1 in place of the base.
struct Excursion {
  double base = 1.0, low = 0.0, high = 1.0;
};

/// The elasticity x/y dy/dx of each parameter of `one_at_a_time`: the slope between the two ends,
/// times the parameter over the output at the base. Trials that have all three points are
/// resampled. Parameters are not named.
std::vector<Elasticity> elasticities(const Outputs& outputs, std::span<const Excursion> excursions,
                                     Resampler& resampler);

/// mu* and sigma of each parameter of `morris_trajectories`, trial noise taken out: of the variance
/// exactly on average, of |effect| as far as `TrialMean::magnitude` can. What that may leave widens
/// the interval of mu*, so that it holds the truth too often where effects are no larger than their
/// noise.
std::vector<ElementaryEffect> elementary_effects(const Points& points, const Outputs& outputs,
                                                 double step, Resampler& resampler);

/// mu* that a parameter without any effect would seem to have where the noise is left in, on
/// average over the steps of the design: sqrt(2 / pi) standard errors of an elementary effect.
double elementary_noise(const Points& points, const Outputs& outputs, double step);

/// Sobol' indices of the points of `saltelli_rows`, as one minus a ratio of mean squares,
///   S_i = 1 - E (f(B) - f(AB_i))^2 / E ((f(B) - m)^2 + (f(AB_i) - m)^2)
///   T_i =     E (f(A) - f(AB_i))^2 / E ((f(A) - m)^2 + (f(AB_i) - m)^2)
/// (Jansen, Comput. Phys. Commun. 117, 1999, with the variance of the very points that are
/// compared, which makes the first the efficient estimate of Janon et al., ESAIM Probab. Stat. 18,
/// 2014). f is the expected value over trials: every square is the mean of products of different
/// trials, paired between points. `parameters` entries, then one for the noise: the variance that a
/// point's mean has from trial to trial, as a share of the same variance.
std::vector<SobolIndex> sobol_indices(std::size_t parameters, const Outputs& outputs,
                                      Resampler& resampler);

}  // namespace gyrostat
