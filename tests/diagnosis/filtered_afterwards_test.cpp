// Recordings that were filtered by whoever made them, and readings that failed.

#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>
#include <gyrostat/tests/diagnosis/turning.hpp>

namespace gyrostat::gap::filtered_afterwards_test {
namespace {

class FilteredRate : public testing::TestWithParam<effects::SensorBandwidth> {};

/// Shifts, filters of the noise and scales stood beside a filter that has not two poles, or
/// instead.
TEST_P(FilteredRate, IsOneEffect) {
  auto names = found_in(turning({GetParam()}, 51));
  names.erase("angle_quantization");  // has odds of one in this noise by itself
  EXPECT_EQ(names, std::set<std::string>{"sensor_bandwidth"});
}

INSTANTIATE_TEST_SUITE_P(
    Each, FilteredRate,
    testing::Values(effects::SensorBandwidth{.cutoff_hz = 3.0, .poles = 4.0, .maximally_flat = 1.0},
                    effects::SensorBandwidth{
                        .cutoff_hz = 1.5, .poles = 2.0, .maximally_flat = 1.0, .zero_phase = 1.0},
                    effects::SensorBandwidth{.cutoff_hz = 1.6, .averages = 2.0},
                    effects::SensorBandwidth{
                        .cutoff_hz = 1.6, .averages = 2.0, .zero_phase = 1.0}));

Scenario ten_minutes(const Effect& effect) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effect};
  return s;
}

/// An average stood beside.
TEST(FilteredNoise, ForwardAndBackIsOneEffect) {
  EXPECT_EQ(found_in(recorded(
                ten_minutes(effects::NoiseBandwidth{
                    .cutoff_hz = 4.0, .poles = 2.0, .maximally_flat = 1.0, .zero_phase = 1.0}),
                52, false)),
            std::set<std::string>{"noise_bandwidth"});
}

/// Where repeats do not count, what foretells the next sample does: as zeros, they made outliers of
/// those behind them, and of the slow noise that they spread over the spectrum sines.
TEST(FilteredNoise, WithRepeatsIsThatAndThese) {
  for (const std::uint64_t seed : {54, 55}) {
    Scenario s = still();
    s.effects = {effects::NoiseBandwidth{.cutoff_hz = 2.0, .poles = 2.0},
                 effects::StaleSamples{.probability = 0.05}};
    EXPECT_EQ(found_in(recorded(s, seed, false)),
              (std::set<std::string>{"noise_bandwidth", "stale_samples"}));
  }
}

/// One pole of Butterworth's at a quarter of the rate is the same.
TEST(FilteredNoise, TheMeanOfTwoSamplesIsAnAverage) {
  EXPECT_EQ(found_in(recorded(ten_minutes(effects::NoiseAveraging{2.0, 1.0}), 53, false)),
            std::set<std::string>{"noise_averaging"});
}

/// Steps of the bias stood for it: a play reaches the other branch too late.
TEST(Hysteresis, OfTheSignOfTheTemperaturesCourseIsFound) {
  Scenario s = still();
  s.effects = {effects::ThermalHysteresis{.amplitude_dps = 0.05, .width_C = 1.0, .sudden = 1.0}};
  EXPECT_EQ(found_in(recorded(s, 54, false)), std::set<std::string>{"thermal_hysteresis"});
}

/// One sample in a thousand shows an end of the sensor's range, at rest and turning: five thousand
/// deviations, of which one is all of its block's level. They were nothing with a name, or clipped.
TEST(FailedReadings, AreOutliers) {
  for (const bool turns : {false, true}) {
    Series series =
        turns ? turning({}, 55) : recorded(ten_minutes(effects::Outliers::absent()), 55, false);
    const NormalStream fails(56, 0, "fails");
    for (std::size_t i = 0; i < series.size(); ++i)
      if (const double u = fails.uniform(i); u < 1e-3)
        series.gyro_dps[i] = u < 5e-4 ? 250.0 : -250.0;
    EXPECT_EQ(found_in(series), std::set<std::string>{"outliers"}) << turns;
  }
}

}  // namespace
}  // namespace gyrostat::gap::filtered_afterwards_test
