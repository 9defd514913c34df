#include <gyrostat/analysis/calibration.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace gyrostat::calibration_test {
namespace {

// It warms from the first sample on, so that the warming of the first interval is known only at its
// end.
TEST(Calibration, TheDriftOfAWarmingGyroHasNoStepAtTheStart) {
  constexpr double rate_hz = 20.0, a = 0.1, b = 50.0, c = -2.0, slope_C_per_s = 0.02;
  Series series;
  for (int i = 0; i < 4000; ++i) {
    series.t_s.push_back(i / rate_hz);
    series.temperature_C.push_back(20.0 + slope_C_per_s * i / rate_hz);
    series.gyro_dps.push_back(a * series.temperature_C.back() + b * slope_C_per_s + c);
  }
  ThermalFit fit;
  fit.parameters = {.a_dps_per_C = a, .b_dps_s_per_C = b, .c_dps = c};
  for (const double left : without_drift(series, fit)) ASSERT_NEAR(left, 0.0, 1e-9);
}

}  // namespace
}  // namespace gyrostat::calibration_test
