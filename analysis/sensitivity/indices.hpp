#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// An estimate with its 95 % interval, in the estimate's unit.
struct Estimate {
  double value = no_value, low = no_value, high = no_value;
};

/// One-at-a-time: relative change of the output per relative change of the parameter, at the base.
struct Elasticity {
  std::string parameter;
  Estimate value;
  double low_output = no_value,
         high_output = no_value;  ///< mean output at the parameter's two ends
};

/// Morris, Technometrics 33, 1991; mu* by Campolongo et al., Environ. Model. Softw. 22, 2007.
struct ElementaryEffect {
  std::string parameter;
  Estimate mu_star, sigma;   ///< in the output's unit, over the parameter's range scaled to [0, 1]
  std::size_t left_out = 0;  ///< steps with fewer than two trials that both of its ends have
};

/// Shares of the output's variance over the design, the trial noise taken out; the noise is a row
/// of its own.
struct SobolIndex {
  std::string parameter;
  Estimate first_order, total;
  std::size_t left_out = 0;  ///< rows with fewer than two trials that all of its points have
};

}  // namespace gyrostat
