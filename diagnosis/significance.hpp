#pragma once

namespace gyrostat::gap {

/// Probability that a recording of the simulator itself shows as much as the clearest of three
/// witnesses: the lenses, whose p-value is uniform; what the likelihood leaves unexplained, whose
/// p-value is a bound that chance hardly reaches; and the odds of the set that was found (log odds
/// of its clearest member, at most 0 where nothing was). Uniform where nothing is to be found.
double p_of_the_clearest(double p_of_lenses, double p_of_the_unexplained, double log_odds);

}  // namespace gyrostat::gap
