#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// One number of a method's errors over trials: their mean, the mean of the worst 5 % (CVaR), or
/// the probability that one is above a limit. Each is the mean of one *score* a trial, so that two
/// methods on the same trials are compared by paired differences of scores, whichever it is.
struct TrialMeasure {
  enum class Kind { mean, cvar95, probability };
  Kind kind = Kind::mean;
  double limit = 0.0;  ///< of the probability, in the errors' unit

  /// As "mean", "mean of the worst 5 %", "probability above 0.05".
  std::string title() const;
  /// The fewest trials that it is worth taking it of: two in the tail.
  std::size_t fewest() const { return kind == Kind::mean ? 16 : 40; }

  /// The error itself; v + (x - v)+ / 0.05 with v the 95 % quantile (Rockafellar and Uryasev, J.
  /// Risk 2, 2000, eq. 4); 1 above the limit and 0 below it. A trial without a value (NaN) has no
  /// score, but is above every limit.
  std::vector<double> scores(std::span<const double> errors) const;

  struct Value {
    double value = no_value;
    double low = no_value, high = no_value;  ///< 95 % interval
    std::size_t trials = 0, missing = 0;
  };
  /// The measure of the trials that have a value, with its interval: of skewed values
  /// (`skewed_mean_interval`), or Wilson's of a probability; none of a CVaR of fewer than 200.
  Value of(std::span<const double> errors) const;

  /// What a search makes small: the measure, none where a trial of a mean has no value. Between
  /// equal probabilities, as where all trials are above the limit, the mean decides.
  double objective(std::span<const double> errors) const;
};

}  // namespace gyrostat
