#pragma once

#include <string>

#include <gyrostat/core/models/thermal_drift.hpp>
#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// A least-squares fit of B_f = a T + b T' + c, with its uncertainty.
struct ThermalFit {
  ThermalDrift<double> parameters;
  ThermalDrift<double> standard_errors;
  double residual_std_dps = 0.0;  ///< of one interval's mean rate
  double temperature_span_C = 0.0;
  std::size_t points = 0;
  std::string message;
};

/// Regresses the mean rate error of successive intervals (gyro minus reference, or the gyro itself
/// where there is no reference: a static recording) on the temperature at their ends and its
/// difference over them, [B eq. 2, 5]. Standard errors are those of least squares under residuals
/// that wander, white noise and a random walk whose strength is averaged over. Where the
/// temperature spans less than 1 °C, a and b are not assessable: they are 0, with infinite standard
/// errors, and c is the mean. Throws InputError for fewer than 4 whole intervals.
///
/// Example: the drift of a recording with temperature, in dps at 40 °C.
///
///   const Series series = read_recording("REC.csv").series;
///   const ThermalFit fit = fit_thermal_drift(series);
///   const double at_40_C = fit.parameters.a_dps_per_C * 40.0 + fit.parameters.c_dps;
///
/// Thread safety: may run in any number of threads at once; it starts none.
ThermalFit fit_thermal_drift(const Series& series, double interval_s = 10.0);

/// Standard deviation, dps, of the bias measurements M that the compass of `series` gives against
/// `drift` [B]; NaN where there are none.
double bias_measurement_std(const Series& series, const ThermalDrift<double>& drift,
                            double interval_s = 10.0);

/// Standard deviation, deg, of one compass reading, from what neighbouring bias measurements share:
/// with M = drift - n_k + n_{k-1} + w_k (n the reading's noise over the interval, w white), the
/// differences of M have the autocovariance n^2 at lag 2, to which neither w nor a bias that
/// wanders adds. 0 where that covariance is negative, NaN where there are no four measurements in a
/// row.
double compass_noise_std(const Series& series, const ThermalDrift<double>& drift,
                         double interval_s = 10.0);

}  // namespace gyrostat
