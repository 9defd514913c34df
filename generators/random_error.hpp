#pragma once

#include <span>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat {

/// Adds the random error x of ARIMA(1,1,1), in dps, to `x`. The first difference starts in its
/// stationary distribution and x_{-1} = 0. Streams "random_error" and "random_error/initial".
void add_random_error(const Arima111<double>& model, const Noise& noise, std::span<double> x);

/// What a_0 does not explain of the stationary first difference, all that came before it: its
/// standard deviation.
double unexplained_difference_dps(const Arima111<double>& model);

/// Adds white noise of the given standard deviation to `values`, from the named stream.
void add_white_noise(double std, const NormalStream& stream, std::span<double> values);

}  // namespace gyrostat
