#pragma once

#include <span>
#include <vector>

#include <gyrostat/analysis/fits/arima_shape.hpp>

namespace gyrostat {

/// The most promising points of a coarse grid, best first; those of a long recording from where
/// its spectrum leads them to. Samples may be missing.
std::vector<ArimaShape> arima_starts(std::span<const double> rate_dps, const ArimaVariant& variant);

}  // namespace gyrostat
