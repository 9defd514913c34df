#pragma once

#include <span>
#include <vector>

#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

namespace gyrostat::gap {

/// Cluster means of the rate error as a level that walks, decaying errors, of which some turn, and
/// white noise, with nothing known of where the level began. Variances may be below 0 where those
/// beside them leave the sum a spectrum: the mean of a strong walk is smoother than a walk.
struct SlowLaw {
  double white;  ///< variance of a mean
  double walk;   ///< variance of the level's step from one mean to the next
  struct Part {
    double variance, decay;  ///< decay from one mean to the next
    bool operator==(const Part&) const = default;
  };
  std::vector<Part> parts;
  /// The real part of a decaying error that turns, by an angle from one mean to the next.
  struct Turning {
    double variance, decay, angle;
    bool operator==(const Turning&) const = default;
  };
  std::vector<Turning> turning{};
  std::optional<Jumps> jumps;
  double interval_s = 1.0;

  /// The same, but for the white noise.
  bool remembers_as(const SlowLaw& other) const {
    return walk == other.walk && parts == other.parts && turning == other.turning &&
           jumps == other.jumps;
  }
};

/// What a filter makes of values: the log-likelihood, and what a Fisher score needs.
struct SlowTerms {
  double log_likelihood = 0.0;
  Eigen::VectorXd coefficients;       ///< of the regressors, most likely
  Eigen::VectorXd coefficients_std;   ///< how well they are known
  double cost_of_coefficients = 0.0;  ///< log-likelihood lost by not knowing them
  std::vector<double> log_variances;  ///< of the innovations but the first
  std::vector<double> innovations;    ///< in units of their standard deviation
  /// What histories of jumps say of each value: which of two levels it is on (-1 to 1), or else the
  /// probability that the level has jumped before it.
  std::vector<double> said;
};

/// Exact likelihood by the Kalman filter with a diffuse level (Harvey, "Forecasting, Structural
/// Time Series Models and the Kalman Filter", 1989, 3.4.3), of `values` at the strictly rising
/// `points`. The coefficients of `regressors` (points x any) are integrated out, with normal priors
/// of the standard deviations `prior_std` (Harvey 1989, 3.4.4, where they are infinite). Jumps,
/// where the law has them, are followed by a Gaussian sum of their histories (Alspach and Sorenson,
/// IEEE Trans. AC-17, 1972). Coefficients beside jumps are integrated out about their maximum
/// (Laplace), given what the histories say: in a few passes, or in one from what those of a law
/// `near` this one say. From terms that are `the_last`, none goes on.
SlowTerms slow_terms(const SlowLaw& law, std::span<const std::size_t> points,
                     const Eigen::VectorXd& values, const Eigen::MatrixXd& regressors,
                     const Eigen::VectorXd& prior_std, const SlowTerms* near = nullptr,
                     bool is_the_last = false);

}  // namespace gyrostat::gap
