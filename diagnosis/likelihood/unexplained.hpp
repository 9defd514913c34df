#pragma once

#include <string>
#include <vector>

#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

namespace gyrostat::gap {

/// A way in which a recording departs from a set of effects, whatever the cause.
struct Unexplained {
  std::string what;
  double p_value;  ///< or a bound of it: that of chance to look as odd in this way
};

/// That of chance to look as odd as the oddest of them in any way (Bonferroni).
double p_of_the_oddest(const std::vector<Unexplained>& ways);

/// Tests of what a fitted set leaves that know no effect of the catalogue: whether the slow rate
/// follows the temperature, its branch, its past, the time, the acceleration or the reference rate
/// in a smooth way that the drift does not have, whether it remembers for longer than noise and for
/// less than a walk, and whether the fast spectrum has the form of the set's.
///
/// Of the slow rate, by the Bayes factor of regressors beside the set, the noise fitted anew; 1
/// over it bounds the p-value (Markov's inequality; Vovk and Wang, Annals of Statistics 49, 2021,
/// e-values). Of the spectrum, by chi-squared of bands of it.
std::vector<Unexplained> unexplained_by(const Conditions& conditions, const SetFitter& fitter,
                                        const Scenario& set);

}  // namespace gyrostat::gap
