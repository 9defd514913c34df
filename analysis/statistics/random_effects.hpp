#pragma once

#include <span>

namespace gyrostat {

/// A parameter of one member of a population, with its standard error.
struct MemberValue {
  double value, error;
};

/// Cochran's Q of members around their weighted mean, with a variance between them; it falls with
/// that.
double q_between(std::span<const MemberValue> members, double variance);

/// The standard deviation between members at which Q is `q`; 0 where it is less without one.
double spread_at(std::span<const MemberValue> members, double q);

/// What members say of the population that they are from.
struct RandomEffects {
  double mean, mean_error;  ///< Hartung and Knapp, Statistics in Medicine 20, 2001: never narrower
                            ///< than the members' own errors make it
  double spread;  ///< standard deviation between members beside their errors (Paule and Mandel,
                  ///< Journal of Research of the NBS 87, 1982)
};

/// Of two members or more. Where all errors are 0 the spread is the members' standard deviation s,
/// the mean is the plain one, and its error is s / sqrt(n).
///
/// Example: three lengths, each known to 0.1.
///
///   const MemberValue lengths[] = {{1.0, 0.1}, {1.6, 0.1}, {2.2, 0.1}};
///   const auto population = random_effects(lengths);
RandomEffects random_effects(std::span<const MemberValue> members);

}  // namespace gyrostat
