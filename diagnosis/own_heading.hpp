#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// What a heading is to the gyro beside it.
enum class HeadingOf {
  compass,       ///< nothing speaks against a compass of this gyro
  another_axis,  ///< another gyro turns with it, and this one does not
  filter         ///< at rest it walks as an integrated gyro does, without a compass's noise
};

/// By what the heading and the rates do from second to second, and at rest from sample to sample:
/// a compass's noise is white and a hundred times what the gyro's is after one step.
HeadingOf heading_of(const Series& recording);

/// The recording without a heading that is no compass of this gyro; `told` hears why.
Series without_foreign_heading(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
