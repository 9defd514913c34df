#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// One term's coefficient. `value` and `standard_error` hold if the terms that are shown are all
/// there are; [lower, upper] is a 95 % interval whatever the other four are. A term that the points
/// do not show has the value 0, no standard error, and `upper` as its one-sided 95 % limit.
struct AllanCoefficient {
  double value = 0.0;
  double standard_error = no_value;
  double lower = 0.0;
  double upper = 0.0;
};

/// Coefficients of the Allan variance of a rate in dps (IEEE Std 952-1997 annex C):
///   sigma^2(tau) = 3 Q^2 / tau^2 + N^2 / tau + (2 ln 2 / pi) B^2 + K^2 tau / 3 + R^2 tau^2 / 2.
struct AllanCoefficients {
  AllanCoefficient quantisation_deg;                   ///< Q, of the angle
  AllanCoefficient angle_random_walk_dps_per_sqrt_hz;  ///< N; white noise's std / sqrt(rate_hz)
  AllanCoefficient bias_instability_dps;               ///< B; the flat part is at 0.664 B
  AllanCoefficient rate_random_walk_dps_sqrt_hz;       ///< K
  AllanCoefficient rate_ramp_dps_per_s;                ///< R
  double shortest_tau_s = 0.0;                         ///< of the points used
  double chi_square = 0.0;                             ///< misfit of all five terms together
  int degrees_of_freedom = 0;                          ///< points used minus terms above 0
  bool adequate = true;                                ///< chi_square is below its 99 % quantile
};

/// The customary units: arcseconds, deg/sqrt(h), deg/h, deg/h/sqrt(h), deg/h^2.
constexpr double quantisation_arcsec(double deg) { return 3600.0 * deg; }
constexpr double angle_random_walk_deg_per_sqrt_h(double dps_per_sqrt_hz) {
  return 60.0 * dps_per_sqrt_hz;
}
constexpr double bias_instability_deg_per_h(double dps) { return 3600.0 * dps; }
constexpr double rate_random_walk_deg_per_h_per_sqrt_h(double dps_sqrt_hz) {
  return 3600.0 * 60.0 * dps_sqrt_hz;
}
constexpr double rate_ramp_deg_per_h2(double dps_per_s) { return 3600.0 * 3600.0 * dps_per_s; }

/// The deviation that the coefficients amount to at tau.
double allan_deviation(const AllanCoefficients& coefficients, double tau_s);

/// 1, 2, 4, ... up to an eighth of `samples`, where a random walk has six degrees of freedom.
std::vector<std::size_t> octave_clusters(std::size_t samples);

/// Non-negative weighted least squares of log sigma^2 on the five terms, at overlapping points.
///
/// A point's log variance has the mean and variance of a log chi-square variable with
/// AllanPoint::edf degrees of freedom, corrected where the fit finds quantisation noise, which that
/// edf takes for white. Neighbouring points are correlated: of those closer than an octave only the
/// first is used, and the rest is weighted with the full correlation matrix, from the spectrum
/// fitted and the gains of the windows (Serroukh, Walden & Percival, JASA 2000).
///
/// A term is shown if it belongs to the set of terms with the least chi-square + 6.63 a term (the
/// 99 % quantile on one degree of freedom). Its interval is where chi-square, least over all other
/// terms, stays within 3.84 (2.71 for an upper limit) of that set's. It therefore covers at least
/// as often as stated if the true terms are among those shown, and reaches down to 0 where another
/// term could stand in. A ramp is no noise: where it rules, its error is overestimated.
///
/// The five terms do not describe every gyro. An anti-aliasing filter lowers the points at the
/// shortest taus, which weigh most: where the terms are not adequate, and leaving out up to half of
/// the points, from the shortest on, makes them so and lowers chi-square by 10.8 a point, that is
/// done. A moving average of 2 to 8 samples then still takes 1 to 6 % from N. If nothing helps (a
/// first-order Markov bias, a vibration), errors grow by the root of chi-square / degrees of
/// freedom.
///
/// Two conventions: a random walk sampled without averaging, as of a recursion x += w, has in
/// addition N^2 = K^2 / (6 rate_hz^2), and flicker noise a white part likewise; and rounding the
/// *rate* (not the angle) makes N, not Q.
///
/// Throws InputError for fewer than five points an octave apart, for a point whose tau, deviation,
/// edf or cluster is not positive and finite, and for taus that do not rise.
AllanCoefficients fit_allan_coefficients(std::span<const AllanPoint> points);

/// The same for a rate sampled at `rate_hz`, at its octave_clusters.
AllanCoefficients fit_allan_coefficients(std::span<const double> rate_dps, double rate_hz);

}  // namespace gyrostat
