#pragma once

#include <limits>
#include <span>
#include <vector>

#include <gyrostat/analysis/fits/arima_sums.hpp>
#include <gyrostat/analysis/fits/arima_whittle.hpp>

namespace gyrostat {

/// Half of a deviance, up to a constant; infinite where the sums are not finite.
double arima_misfit(const ArimaSums& sums);

/// The profile likelihood of ARIMA(1,1,1) + white noise for a recording: one parameter held, all
/// others free.
///
/// Of a long recording a point's search goes over the spectrum, and the exact likelihood is asked
/// where that ends. Where the spectrum's deviance from the likeliest model is above 200, a point
/// that no test comes near, it stands for the exact one.
///
/// Thread safety: any number of threads may ask one at once.
class ArimaProfile {
 public:
  enum Parameter { phi, delta1, delta2, measurement_noise_std };

  struct Point {
    double misfit = std::numeric_limits<double>::infinity();  ///< half of a deviance
    Arima111<double> at{};
  };

  /// `likeliest` of `rate_dps`, which is looked at again for every point.
  ArimaProfile(std::span<const double> rate_dps, const Arima111<double>& likeliest);

  const Arima111<double>& likeliest() const { return starts_.back(); }
  double least_misfit() const { return least_; }
  /// Where the misfit is least with `held` at `value`.
  Point point(Parameter held, double value) const;

 private:
  std::span<const double> z_;
  ArimaWhittle spectrum_;
  std::vector<Arima111<double>> starts_;  ///< the last is the likeliest
  double least_, least_by_spectrum_;
};

}  // namespace gyrostat
