#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// A sensor that turns without a reference that says how.
struct UnreferencedTurning {
  double extent_dps = 0.0;    ///< of the axis that turns most; 0 where there is none
  std::vector<char> at_rest;  ///< a flag a sample
  double rest_s = 0.0;        ///< how long that is altogether

  explicit operator bool() const { return extent_dps > 0.0; }
};

/// None where there is a rate_ref_dps or the sensor rests: turning is 5 dps and more on any of the
/// axes, of which 2 come and go within a second. Rests last two seconds and longer, half a second
/// from any turn; all axes are steady there, and within 1 dps of where they are nearest to zero: at
/// an even turn they are steady, too.
UnreferencedTurning turning_without_reference(const Series& recording);

/// The recording with its rests alone, where these are 20 s and more, two fifths of it and two
/// seconds of each quarter: what was turned between them, nobody knows, so that a heading goes with
/// the turns. `told` hears of it, and where there is not as much rest, that turns are taken for
/// errors.
Series without_turning(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
