#pragma once

#include <string_view>

namespace gyrostat {

/// Which values of a metric are good.
enum class Goal {
  small,       ///< the smaller, the better, whatever its sign
  near_zero,   ///< an error: small in size
  consistent,  ///< tells whether a filter is what it states of itself
  none,        ///< neither good nor bad
};

/// A metric's own table among those of errors.
struct TableOf {
  int place = 0;  ///< from 1; of the same place, the one that the cell is judged by; 0: no table
  std::string_view title{};
  std::string_view difference{};  ///< as the table of paired differences calls it, where it judges
};

}  // namespace gyrostat
