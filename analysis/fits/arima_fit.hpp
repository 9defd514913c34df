#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include <gyrostat/core/models/arima111.hpp>

namespace gyrostat {

/// What a fit of ARIMA(1,1,1) + white noise to a static recording says.
///
/// Example: whether a fit tells phi at all.
///
///   const auto tells_phi = [](const ArimaFit& fit) {
///     return fit.converged && fit.standard_errors.phi < 0.1;
///   };
struct ArimaFit {
  Arima111<double> parameters;
  Arima111<double> standard_errors;
  /// Of a fit by likelihood, whose `parameters` may be of a simpler model: the likeliest of all
  /// four.
  std::optional<Arima111<double>> likeliest;
  /// Of phi, delta1, delta2 and sqrt(R), in that order and in their units.
  std::array<std::array<double, 4>, 4> covariance{};
  bool converged = false;
  std::string message;
  int iterations = 0;
  std::size_t first = 0, samples = 0;  ///< that were fitted
  /// Samples that each of the fitted values is the mean of: more than one where noise is coloured.
  std::size_t cluster = 1;
  /// Maximum likelihood: the log-likelihood. Moments: the chi-square of the misfit.
  double objective = 0.0;
};

}  // namespace gyrostat
