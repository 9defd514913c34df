#pragma once

#include <limits>
#include <span>
#include <vector>

#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/analysis/fits/arima_sums.hpp>

namespace gyrostat {

/// Half of a deviance, up to a constant; infinite where the sums are not finite.
double arima_misfit(const ArimaSums& sums);

/// A point of a profile likelihood.
struct LeastMisfit {
  double misfit = std::numeric_limits<double>::infinity();
  Arima111<double> at{};
};

/// The least misfit of models of `z` with one parameter held at `value`, by descents from the most
/// promising of `starts`, side by side.
LeastMisfit least_misfit(std::span<const double> z, ArimaIntervals::Parameter held, double value,
                         std::span<const Arima111<double>> starts);

/// The likeliest of models all over what is possible, each at the scale that suits `z` best.
std::vector<Arima111<double>> likely_arima_models(std::span<const double> z);

}  // namespace gyrostat
