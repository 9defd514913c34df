#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/autoregression.hpp>

namespace gyrostat::gap {

/// How many samples before one it is foretold by.
constexpr std::size_t samples_before = 16;
/// Fewer tell nothing.
constexpr std::size_t fewest_innovations = 500;
/// Standard deviations beyond which a sample does not count at first.
constexpr double far_off = 4.0;

/// Errors of what was foretold, a value each of the samples that have so many before them.
struct Whitened {
  std::vector<std::size_t> samples;
  std::vector<double> innovations;
};

/// Samples as those before them foretell them, by an autoregression of the train part.
struct Foretold {
  Autoregression law;
  std::vector<double> history;  ///< that they are foretold by
  std::vector<double> ahead;    ///< deviation of a sample's error, of that of one step ahead
  Whitened errors;              ///< of the train part, each as of one step ahead
};

/// From all that was before. `given_dps` is a value a sample, NaN where unknown.
Foretold foretold(const Conditions& conditions, const std::vector<double>& given_dps);

/// From a past without outliers: what is far from its prediction is replaced by it (Martin and
/// Thomson, Proc. IEEE 70, 1982), so that an outlier is one innovation and not seventeen. From
/// samples replaced in a row the next is foretold as many steps ahead.
Foretold foretold_beside_outliers(const Conditions& conditions,
                                  const std::vector<double>& given_dps);

/// Of a sample of a span that begins at `first`; what is missing before it is as if it were zero.
double prediction(const Foretold& by, std::size_t sample, std::size_t first);

/// Response of the autoregression to one innovation, until little is left of it.
std::vector<double> response_to_one(const Autoregression& law);

/// The values of the train part that are known.
std::vector<double> present_in_train(const Conditions& conditions,
                                     const std::vector<double>& values);

/// By the median of what they are off from zero, as of normal ones.
double robust_deviation(std::vector<double> values);

}  // namespace gyrostat::gap
