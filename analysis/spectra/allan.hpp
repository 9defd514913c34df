#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrostat {

/// One point of an Allan deviation plot; deviation and interval in the unit of the rate.
struct AllanPoint {
  double tau_s;
  double deviation;
  double lower, upper;   ///< confidence interval of the deviation
  double edf;            ///< equivalent degrees of freedom of its square, as the interval has them
  std::size_t cluster;   ///< samples averaged, tau times the rate of sampling
  double power_law_edf;  ///< those of the nearest of white, flicker and random-walk rate noise
};

/// Cluster sizes from 1 to a quarter of `samples`, about eight a decade. A quarter leaves two to
/// four degrees of freedom: the interval is wide, and still holds.
std::vector<std::size_t> allan_clusters(std::size_t samples);

/// Overlapping Allan deviation (IEEE Std 952-1997 annex C; NIST SP 1065 eq. 11) of a rate sampled
/// at `rate_hz`, in O(n) a cluster; of more than a million places those a 64th of a cluster apart
/// stand for all. The interval is chi-square with the equivalent degrees of
/// freedom that the rate's own autocovariance gives where there are 32 clusters or more. Where
/// there are fewer, they are those of Greenhall & Riley (PTTI 2003) for white, flicker or
/// random-walk rate noise, whichever the lag-1 autocorrelation identifies at that tau, or at n/32
/// samples where it is longer (Riley & Greenhall, EFTF 2004).
///
/// Missing samples (NaN) are left out: of all pairs of clusters those count in which at most a
/// fifth of either is missing, and a tau without such a pair has no point. Throws InputError for an
/// infinite sample, for a cluster outside [1, n/2], a rate of sampling <= 0, and a confidence
/// outside (0, 1).
///
/// Example: a curve with its 95 % intervals.
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 0}, series);
///   for (const auto& p : overlapping_allan_deviation(series.gyro_dps, series.rate_hz()))
///     std::printf("%g s: %g (%g to %g) dps\n", p.tau_s, p.deviation, p.lower, p.upper);
///
/// Thread safety: may run in any number of threads at once; it starts none.
std::vector<AllanPoint> overlapping_allan_deviation(std::span<const double> rate, double rate_hz,
                                                    std::span<const std::size_t> clusters = {},
                                                    double confidence = 0.95);

/// The rate with spikes and missing samples replaced by the median of the nine samples around
/// them. A spike is farther from that median than six standard deviations of the noise, estimated
/// from the 90 % quantile of the first differences: up to 5 % of the samples may be spikes, noise
/// that is a mixture keeps its variance, Gaussian noise loses less than 1e-6 of it.
std::vector<double> without_spikes(std::span<const double> rate);

/// Allan variance at each cluster by a Huber M-estimator of the scale of the overlapping Haar
/// coefficients w (Mondal & Percival 2012): the nu with mean min(w^2 / nu, 16) = E min(Z^2, 16),
/// Z ~ N(0, 1), which makes it consistent for Gaussian w. Its efficiency is 99.9 %; it withstands
/// 6 % of arbitrary coefficients. Throws as overlapping_allan_deviation.
std::vector<double> robust_allan_variances(std::span<const double> rate,
                                           std::span<const std::size_t> clusters);

}  // namespace gyrostat
