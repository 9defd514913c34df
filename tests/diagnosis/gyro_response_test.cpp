// The short way to what effects make of a rate.

#include <gyrostat/diagnosis/gyro_response.hpp>

#include <gmock/gmock.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::gyro_response_test {
namespace {

TEST(GyroResponse, HasTheBitsOfASimulatorWithoutNoiseAndDrift) {
  Series conditions = recorded(moving(), 3, true);
  for (std::size_t i = 200; i < 230; ++i) conditions.gyro_dps[i] = no_value;
  for (std::size_t i = 400; i < 410; ++i) conditions.rate_ref_dps[i] = no_value;
  Scenario quiet;
  quiet.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  quiet.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  const GyroResponse response(conditions);
  Series made;
  const auto expect_same = [&](const std::vector<double>& gyro) {
    synthesise_rate_under(quiet, conditions, {}, made);
    ASSERT_EQ(gyro.size(), made.size());
    for (std::size_t i = 0; i < gyro.size(); ++i)
      if (is_missing(made.gyro_dps[i]))
        ASSERT_TRUE(is_missing(gyro[i])) << i;
      else
        ASSERT_EQ(gyro[i], made.gyro_dps[i]) << i;
  };
  expect_same(response.still());
  // A limit first, which acts after what comes behind it; and once more, from the same copy.
  quiet.effects = {effects::Saturation{.limit_dps = 60.0},
                   effects::SensorBandwidth{.cutoff_hz = 2.0}, effects::ScaleFactor{0.01},
                   effects::Sinusoidal{.amplitude_dps = 0.1, .frequency_hz = 0.5}};
  for (int time = 0; time < 2; ++time) expect_same(response.of(quiet.effects));
}

}  // namespace
}  // namespace gyrostat::gap::gyro_response_test
