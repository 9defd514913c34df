#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/generators/environment/magnetic/compass.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>

namespace gyrostat::environment_test {
namespace {

using temperature::Cycle;
using temperature::QuietRoom;
using temperature::RampAndCooling;
using temperature::Recorded;

TEST(QuietRoom, GoesFromStartTowardsItsEndByTheExponentialLaw) {
  const QuietRoom room{.start_C = 37.8, .end_C = 40.1, .time_constant_s = 20.0};
  EXPECT_DOUBLE_EQ(room(0.0), 37.8);
  EXPECT_DOUBLE_EQ(room(20.0), 40.1 - 2.3 * std::exp(-1.0));
  EXPECT_NEAR(room(1e4), 40.1, 1e-12);
}

TEST(RampAndCooling, WaitsRampsAndCools) {
  const RampAndCooling chamber{.start_C = 23.0,
                               .peak_C = 57.0,
                               .room_C = 21.0,
                               .delay_s = 100.0,
                               .ramp_s = 1200.0,
                               .cooling_time_constant_s = 800.0};
  EXPECT_EQ(chamber(0.0), 23.0);
  EXPECT_EQ(chamber(100.0), 23.0);
  EXPECT_DOUBLE_EQ(chamber(700.0), 40.0);
  EXPECT_DOUBLE_EQ(chamber(1300.0), 57.0);
  EXPECT_DOUBLE_EQ(chamber(2100.0), 21.0 + 36.0 * std::exp(-1.0));
  EXPECT_NEAR(chamber(1e5), 21.0, 1e-12);
}

TEST(Cycle, StartsLowAndReachesBothEnds) {
  const Cycle cycle{.low_C = 23.0, .high_C = 57.0, .period_s = 3600.0};
  EXPECT_DOUBLE_EQ(cycle(0.0), 23.0);
  EXPECT_DOUBLE_EQ(cycle(900.0), 40.0);
  EXPECT_DOUBLE_EQ(cycle(1800.0), 57.0);
  EXPECT_NEAR(cycle(3600.0), 23.0, 1e-12);
}

/// Two hours of each at its defaults: no jump between samples 10 ms apart.
TEST(Temperature, IsContinuous) {
  const auto largest_step = [](const auto& profile) {
    double worst = 0.0;
    for (int i = 1; i < 720'000; ++i)
      worst = std::max(worst, std::abs(profile(0.01 * i) - profile(0.01 * (i - 1))));
    return worst;
  };
  EXPECT_LT(largest_step(QuietRoom{}), 0.01 * 2.3 / 20.0 * 1.001);
  EXPECT_LT(largest_step(RampAndCooling{}), 0.01 * 34.0 / 800.0 * 1.001);
  EXPECT_LT(largest_step(Cycle{}), 0.01 * 17.0 * 2.0 * std::numbers::pi / 3600.0 * 1.001);
}

Recorded recorded() {
  auto series = std::make_shared<Series>();
  series->t_s = {50.0, 51.0, 53.0, 53.5};
  series->temperature_C = {20.0, 22.0, 21.0, 30.0};
  return {series};
}

TEST(Recorded, PassesThroughItsSamplesCountedFromTheFirst) {
  const auto profile = recorded();
  EXPECT_DOUBLE_EQ(profile(0.0), 20.0);
  EXPECT_DOUBLE_EQ(profile(1.0), 22.0);
  EXPECT_DOUBLE_EQ(profile(3.0), 21.0);
  EXPECT_DOUBLE_EQ(profile(3.5), 30.0);
}

TEST(Recorded, IsLinearBetweenSamplesAndHeldOutside) {
  const auto profile = recorded();
  EXPECT_DOUBLE_EQ(profile(0.25), 20.5);
  EXPECT_DOUBLE_EQ(profile(2.0), 21.5);
  EXPECT_DOUBLE_EQ(profile(3.25), 25.5);
  EXPECT_DOUBLE_EQ(profile(-1.0), 20.0);
  EXPECT_DOUBLE_EQ(profile(1e6), 30.0);
}

/// The turn in degrees after `samples` at `rate_hz`, as the compass integrates it.
template <class Motion>
double turn(const Motion& motion, int samples, double rate_hz) {
  double sum = 0.0;
  for (int i = 1; i <= samples; ++i) sum += motion(i / rate_hz) / rate_hz;
  return sum;
}

TEST(RateTable, ReturnsToItsStartHeadingAfterEveryCycle) {
  const motion::RateTable table{.rate_dps = 10.0, .period_s = 40.0};
  for (const int cycles : {1, 2, 5}) EXPECT_NEAR(turn(table, cycles * 4000, 100.0), 0.0, 1e-9);
  EXPECT_NEAR(turn(table, 1500, 100.0), 100.0, 0.2);  // +rate for 10 s, then rest
}

TEST(RateTable, TurnsRestsTurnsBackAndRests) {
  const motion::RateTable table{.rate_dps = 10.0, .period_s = 40.0};
  EXPECT_EQ(table(5.0), 10.0);
  EXPECT_EQ(table(15.0), 0.0);
  EXPECT_EQ(table(25.0), -10.0);
  EXPECT_EQ(table(35.0), 0.0);
  EXPECT_EQ(table(45.0), 10.0);
}

TEST(Sinusoidal, SwingsAboutZero) {
  const motion::Sinusoidal table{.amplitude_dps = 10.0, .frequency_hz = 0.1};
  EXPECT_NEAR(turn(table, 1000, 100.0), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(table(2.5), 10.0);
  EXPECT_DOUBLE_EQ(table(7.5), -10.0);
}

TEST(Level, IsGravityOnTheZAxis) {
  EXPECT_EQ(acceleration::Level{}(12.0), (std::array{0.0, 0.0, 9.80665}));
}

TEST(Shaking, ShakesTheFirstPartOfEachCycleAlongZ) {
  const acceleration::Shaking table{
      .amplitude_mps2 = 2.0, .frequency_hz = 0.25, .period_s = 40.0, .shaken = 0.25};
  for (const double t : {1.0, 5.0, 41.0}) EXPECT_NEAR(table(t)[2], 11.80665, 1e-12) << t;
  for (const double t : {13.0, 37.0}) EXPECT_EQ(table(t)[2], 9.80665) << t;
  EXPECT_EQ(table(1.0)[0], 0.0);
  EXPECT_EQ(table(1.0)[1], 0.0);
}

TEST(Tilting, TurnsGravityAndKeepsItsSize) {
  const acceleration::Tilting tilting{.roll_amplitude_deg = 90.0,
                                      .roll_period_s = 40.0,
                                      .pitch_amplitude_deg = 30.0,
                                      .pitch_period_s = 80.0};
  const auto level = tilting(0.0);
  EXPECT_NEAR(level[2], 9.80665, 1e-12);
  for (const double t : {3.0, 10.0, 17.0, 55.0}) {
    const auto [x, y, z] = tilting(t);
    EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), 9.80665, 1e-12);
  }
  const auto [x, y, z] = tilting(20.0);  // roll is back at 0, pitch at its largest
  EXPECT_NEAR(x, -0.5 * 9.80665, 1e-12);
  EXPECT_NEAR(y, 0.0, 1e-12);
  EXPECT_NEAR(tilting(10.0)[2], 0.0, 1e-12);  // on its side
  EXPECT_GT(tilting(10.0)[1], 0.0);
  EXPECT_GT(z, 0.0);
}

TEST(Stationary, DoesNotTurn) { EXPECT_EQ(turn(motion::Stationary{}, 1000, 100.0), 0.0); }

/// A compass at 10 Hz beside a gyro that turns at `rate_dps`.
Series observed(const Compass& compass, double rate_dps, std::size_t samples,
                std::uint32_t trial = 0) {
  Series series;
  for (std::size_t i = 0; i < samples; ++i) {
    series.t_s.push_back(0.1 * static_cast<double>(i));
    series.rate_ref_dps.push_back(rate_dps);
  }
  compass.observe(series, {4, trial});
  return series;
}

TEST(Compass, WithoutNoiseIsTheWrappedIntegralOfTheRate) {
  const auto series = observed(
      {.noise_std_deg = 0.0, .initial_heading_deg = 170.0, .disturbances = {}}, 25.0, 1000);
  for (std::size_t i = 0; i < series.size(); ++i) {
    EXPECT_GE(series.heading_deg[i], -180.0);
    EXPECT_LT(series.heading_deg[i], 180.0);
    EXPECT_NEAR(std::remainder(series.heading_deg[i] - 170.0 - 2.5 * static_cast<double>(i), 360.0),
                0.0, 1e-9);
  }
}

// Mean and mean square of n independent normals, at 5 standard errors: 6e-7 each.
TEST(Compass, NoiseIsWhiteWithItsStandardDeviation) {
  constexpr std::size_t n = 100000;
  const auto series = observed({.noise_std_deg = 0.5, .disturbances = {}}, 0.0, n);
  double sum = 0.0, square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += series.heading_deg[i] / n;
    square += series.heading_deg[i] * series.heading_deg[i] / n;
    if (i > 0) product += series.heading_deg[i] * series.heading_deg[i - 1] / n;
  }
  EXPECT_NEAR(sum, 0.0, 5.0 * 0.5 / std::sqrt(n));
  EXPECT_NEAR(square / 0.25, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(product / 0.25, 0.0, 5.0 / std::sqrt(n));
}

TEST(Compass, ADisturbanceOffsetsExactlyItsHalfOpenPeriodAndFlagsIt) {
  Compass compass;
  const auto before = observed(compass, 3.0, 1000);
  compass.disturbances = {
      {.start_s = 20.0, .duration_s = 30.0, .offset_deg = 15.0, .noise_std_deg = 0.0}};
  const auto after = observed(compass, 3.0, 1000);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const bool inside = after.t_s[i] >= 20.0 && after.t_s[i] < 50.0;
    EXPECT_EQ(after.mag_valid[i], inside ? 0.0 : 1.0) << after.t_s[i];
    const double moved = wrap_degrees(after.heading_deg[i] - before.heading_deg[i]);
    EXPECT_NEAR(moved, inside ? 15.0 : 0.0, 1e-9) << after.t_s[i];
  }
}

TEST(Compass, AnUnnoticedDisturbanceIsNotFlagged) {
  Compass compass;
  compass.disturbances = {{.start_s = 10.0, .duration_s = 20.0, .flagged = 0.0}};
  const auto series = observed(compass, 0.0, 1000);
  EXPECT_TRUE(std::all_of(series.mag_valid.begin(), series.mag_valid.end(),
                          [](double valid) { return valid == 1.0; }));
  EXPECT_GT(std::abs(series.heading_deg[200]), 3.0);
}

// The mean square of n normals at 5 standard errors: 6e-7.
TEST(Compass, ADisturbanceAddsItsOwnNoise) {
  constexpr std::size_t n = 50000;
  Compass compass;
  compass.noise_std_deg = 0.0;
  compass.disturbances = {
      {.start_s = 0.0, .duration_s = 1e9, .offset_deg = 0.0, .noise_std_deg = 2.0}};
  const auto series = observed(compass, 0.0, n);
  const double square = std::inner_product(series.heading_deg.begin(), series.heading_deg.end(),
                                           series.heading_deg.begin(), 0.0) /
                        n;
  EXPECT_NEAR(square / 4.0, 1.0, 5.0 * std::sqrt(2.0 / n));
}

// Of two disturbances at once the noises are independent: variances add. At 5 standard errors:
// 6e-7.
TEST(Compass, OverlappingDisturbancesHaveNoisesOfTheirOwn) {
  constexpr std::size_t n = 50000;
  Compass compass;
  compass.noise_std_deg = 0.0;
  const MagneticDisturbance disturbance{
      .start_s = 0.0, .duration_s = 1e9, .offset_deg = 0.0, .noise_std_deg = 2.0};
  compass.disturbances = {disturbance, disturbance};
  const auto series = observed(compass, 0.0, n);
  const double square = std::inner_product(series.heading_deg.begin(), series.heading_deg.end(),
                                           series.heading_deg.begin(), 0.0) /
                        n;
  EXPECT_NEAR(square / 8.0, 1.0, 5.0 * std::sqrt(2.0 / n));
}

}  // namespace
}  // namespace gyrostat::environment_test
