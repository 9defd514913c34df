#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Ljung and Box's Q (Biometrika 65, 1978) of the normalised innovations at lags 1 to 10: 10 on
/// average where they are white.
struct LjungBox {
  static constexpr std::string_view title = "whiteness of the innovations, Q of lags 1 to 10";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.innovations.ljung_box; }
};

}  // namespace gyrostat::metrics
