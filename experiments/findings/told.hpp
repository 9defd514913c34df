#pragma once

#include <cmath>

#include <gyrostat/core/table.hpp>

namespace gyrostat {

/// An uncertainty as a table tells it: infinite is that of what the signal does not tell.
inline TableCell told(double uncertainty) {
  return std::isinf(uncertainty) ? TableCell("cannot be told") : cell(uncertainty);
}

}  // namespace gyrostat
