#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/generators/effects/outliers.hpp>

namespace gyrostat::gap {

/// What the sizes of innovations say; of outliers, only where they come one by one.
struct Tails {
  std::vector<effects::Outliers> populations;  ///< of outliers
  double outlier_gain = 0.0;                   ///< log-likelihood beyond normal innovations
  double noise_per_C = 0.0, noise_per_C2 = 0.0, reference_C = 0.0;
  double temperature_gain = 0.0;       ///< log-likelihood beyond even noise
  double mean_square_of_warmth = 1.0;  ///< of the size relative to that at the reference
  /// By how many turns a sample the size of innovations goes round; 0: it does not. The largest of
  /// them are then no outliers.
  double turns = 0.0;
  std::vector<char> outliers;  ///< a flag a sample, of all samples: far off
  double quiet = 1.0;          ///< of the deviation of samples without a flag, what is no outliers'
  /// Whether outliers pass what colours the noise, and all that comes after them with it (Fox, J.
  /// Roy. Stat. Soc. B 34, 1972: type II). Then all samples count, and `quiet` is of them.
  bool innovational = false;
  double deviation = 0.0;  ///< of an innovation that is none, dps
};

/// Whether a sample may follow outliers before it, as behind a filter.
enum class Past { is_quiet, may_be_of_outliers };

/// Innovations of an autoregression fitted to the train part of `left_dps` (NaN: unknown): what a
/// set of effects leaves of the rate, without its slow part. `temperature` says whether the noise
/// may follow it.
Tails tails_of(const Conditions& conditions, const std::vector<double>& left_dps, bool temperature,
               Past past = Past::is_quiet);

}  // namespace gyrostat::gap
