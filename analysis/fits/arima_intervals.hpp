#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <gyrostat/analysis/fits/arima_fit.hpp>
#include <gyrostat/analysis/fits/arima_profile.hpp>

namespace gyrostat {

/// Values that are nearly as likely as those of a fit, and far from them: the likelihood falls
/// between.
struct ArimaMode {
  Arima111<double> parameters;
  double deviance = 0.0;  ///< twice by what the log-likelihood falls short of its maximum
};

/// Confidence intervals of the parameters of ARIMA(1,1,1) + white noise by profile likelihood: the
/// values that a likelihood-ratio test does not reject, all other parameters free (Venzon and
/// Moolgavkar, Applied Statistics 37, 1988). Where a signal hardly tells phi from delta2 or delta1
/// from R the likelihood is no parabola, and these hold where multiples of a standard error do not.
/// Where it has several maxima, they span all of those that a test of all four parameters together
/// does not reject (5 %).
///
/// Example: the 95 % interval of phi.
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 0}, series);
///   const ArimaIntervals intervals(fit_arima_likelihood(series.gyro_dps), series.gyro_dps);
///   const auto [low, high] = intervals.interval(ArimaIntervals::phi);
///
/// Thread safety: any number of threads may ask one at once.
class ArimaIntervals {
 public:
  using Parameter = ArimaProfile::Parameter;
  using enum ArimaProfile::Parameter;

  /// `fit` by likelihood to `rate_dps`, which is looked at again for every value. Throws as the
  /// fit.
  ArimaIntervals(const ArimaFit& fit, std::span<const double> rate_dps);

  /// Twice by what the log-likelihood falls short of its maximum where the parameter has `value`:
  /// chi-squared with one degree of freedom at the truth.
  double deviance(Parameter parameter, double value) const;

  /// In the parameter's unit; an end is -1, 0 or 1 where that is the end of what the parameter may
  /// be. Wide enough to hold the fit, which may be of a simpler model.
  std::array<double, 2> interval(Parameter parameter, double confidence = 0.95) const;

  /// The other maxima along phi, to the grid on which they are looked for.
  std::span<const ArimaMode> other_modes() const { return other_modes_; }

  /// Whether the interval holds `value`.
  bool holds(Parameter parameter, double value, double confidence = 0.95) const {
    return std::sqrt(deviance(parameter, value)) <= reach(confidence);
  }

 private:
  void find_other_modes();
  /// The root of the deviance at the interval's ends.
  double reach(double confidence) const;
  /// The end of the interval on the side of `limit`, which may be infinite.
  double end(Parameter parameter, double limit, double reach) const;

  ArimaProfile profile_;  ///< about the fit of all four parameters
  Arima111<double> reported_, errors_;
  double needed_;  ///< the highest deviance of the fit and the other modes
  std::vector<ArimaMode> other_modes_;
};

}  // namespace gyrostat
