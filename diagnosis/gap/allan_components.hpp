#pragma once

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/diagnosis/gap/scene.hpp>

namespace gyrostat::gap {

/// Allan variance of a Gauss-Markov process of unit variance at tau = u correlation times: half the
/// mean square difference of neighbouring means (IEEE Std 952 annex C, where it is stated for a
/// driving noise, which makes the variance).
double gauss_markov_allan_variance(double u);

/// A slow error to be fitted beside ARIMA(1,1,1) and white noise.
enum class SlowComponent { none, gauss_markov, flicker };

struct AllanComponents {
  Arima111<double> random_error;
  double slow_std_dps = 0.0;  ///< of the Gauss-Markov process, or the bias instability coefficient
  double correlation_time_s = 0.0;
  double misfit = 0.0;  ///< robust, in units of the sampling error
};

/// Matches the Allan variances of the train part, of samples and of clusters without the drift,
/// robustly. The memory of the ARIMA increments is at most fifty samples: longer
/// correlations are Gauss-Markov noise, which has a name of its own. Without `walk` the slow
/// component is all there is beside white noise: a random walk may stand in for it on short
/// records.
AllanComponents fit_allan_components(const Conditions& conditions, const Scene& scene,
                                     SlowComponent component, bool walk = true);

}  // namespace gyrostat::gap
