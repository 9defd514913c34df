#pragma once

#include <vector>

#include <gyrostat/experiments/findings/failures.hpp>

namespace gyrostat {

/// A method by how likely it fails.
struct RankedFailure {
  std::string method;
  double probability = no_value;  ///< none where it is bounded, or not told
  double low = 0.0, high = 1.0;   ///< 95 %; below a bound: 0 to the 97.5 % bound
};

/// One method against the next less likely to fail: how many times as likely `worse` fails.
struct FailureRatio {
  std::size_t better = 0, worse = 0;       ///< indices into the ranking
  double low = no_value, high = no_value;  ///< 95 %, for all pairs together
  bool separable() const { return low > 1.0; }
};

/// Least likely first; by its bound where that is all there is, and at the end what is not told.
std::vector<RankedFailure> rank_failures(const std::vector<FailureFinding>& findings);

/// Of neighbours in a ranking whose failures are told. The interval of a ratio is made of those of
/// both, in logarithms (the method of variance estimates recovery: Zou and Donner, Stat. Med. 27,
/// 2008, which needs no symmetry), widened for all pairs of the ranking (Bonferroni). Plain trials
/// of both are on the same signals, for which nothing is taken off.
std::vector<FailureRatio> failure_ratios(const std::vector<RankedFailure>& ranking);

/// One row a method, with sentences as notes.
Table failure_ranking_table(const Cell& cell, const std::vector<FailureFinding>& findings);

}  // namespace gyrostat
