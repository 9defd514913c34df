// What no name explains, modelled as it shows.

#include <gyrostat/diagnosis/likelihood/nameless.hpp>

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include <gyrostat/diagnosis/handling.hpp>
#include <gyrostat/diagnosis/likelihood/autoregression.hpp>
#include <gyrostat/diagnosis/likelihood/nameless_mean.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/generators/all_pole.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::nameless_test {
namespace {

/// An autoregression is found again from its own autocovariance, which is the transform of its
/// spectrum.
TEST(Autoregression, IsFoundFromItsSpectrum) {
  const std::array<double, 3> reflections{-0.6, 0.3, -0.2};
  const AllPole<3> filter(reflections);
  std::vector<double> autocovariance(6, 0.0);
  constexpr int points = 4096;
  for (int k = 0; k < points; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / points;
    for (std::size_t lag = 0; lag < autocovariance.size(); ++lag)
      autocovariance[lag] +=
          filter.gain(angle) * std::cos(angle * static_cast<double>(lag)) / points;
  }
  EXPECT_NEAR(autocovariance[0], filter.variance(), 1e-9);
  const auto found = autoregression(autocovariance);
  for (std::size_t m = 0; m < 3; ++m) EXPECT_NEAR(found.reflections[m], reflections[m], 1e-9);
  for (std::size_t m = 3; m < 5; ++m) EXPECT_NEAR(found.reflections[m], 0.0, 1e-9);
  EXPECT_NEAR(found.errors.back(), 1.0, 1e-9);
}

/// The lattice does what the difference equation of the same polynomial does.
TEST(AllPole, IsItsDifferenceEquation) {
  AllPole<2> filter({-0.5, 0.4});
  // Levinson's step up: a1 = k1 (1 + k2), a2 = k2.
  const double a1 = -0.5 * 1.4, a2 = 0.4;
  double last = 0.0, before_last = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double white = std::sin(1.7 * i), direct = white - a1 * last - a2 * before_last;
    EXPECT_NEAR(filter(white), direct, 1e-12);
    before_last = last;
    last = direct;
  }
}

/// What the simulator as it stands, fitted, leaves.
std::vector<Nameless> left_by_the_baseline(const Scenario& scenario, std::uint64_t seed) {
  const Series series = recorded(scenario, seed, false);
  const Simulator simulator(series, 1);
  const auto standing = SetBench(simulator, series, {}).beside_noise({});
  return nameless_parts(simulator, series, *standing.fitter, standing.scenario,
                        likeliest_baseline(simulator, series));
}

/// Each part has to gain ten nats beyond a nat a parameter, which chance does in less than one
/// recording of 10,000.
TEST(Nameless, IsNothingWhereNothingIsLeft) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_TRUE(left_by_the_baseline(still(), seed).empty());
}

/// A hump over temperature that is no polynomial: as high as the noise of a sample. Its height
/// is known to a few thousandths of a dps, beside a walk that is small against it.
TEST(Nameless, IsTheMeanOverTemperature) {
  Scenario s = still();
  s.effects = {effects::EmpiricalMeanOverTemperature{
      .from = 23.0, .span = 34.0, .mean_4_dps = 0.06, .mean_5_dps = 0.06}};
  const auto parts = left_by_the_baseline(s, 4);
  ASSERT_EQ(parts.size(), 1);
  const auto* mean = parts[0].effect.as<effects::EmpiricalMeanOverTemperature>();
  ASSERT_NE(mean, nullptr);
  // The drift beside it may have taken a line.
  const double line = 0.5 * (mean->mean_1_dps + mean->mean_9_dps);
  EXPECT_NEAR(0.5 * (mean->mean_4_dps + mean->mean_5_dps) - line, 0.06, 0.01);
  EXPECT_NEAR(0.5 * (mean->mean_2_dps + mean->mean_8_dps) - line, 0.0, 0.01);
  ASSERT_TRUE(parts[0].beside);
  EXPECT_THAT(parts[0].in_words, testing::HasSubstr("over the temperature"));
}

/// Turned to and fro 37 times, beside a reference.
TEST(Nameless, IsTheMeanOverTheRate) {
  Scenario s = moving();
  s.effects = {effects::EmpiricalMeanOverRate{
      .from = -80.0, .span = 160.0, .mean_1_dps = 0.06, .mean_5_dps = 0.0, .mean_9_dps = 0.06}};
  const Series series = recorded(s, 4, true);
  const Simulator simulator(series, 1);
  const auto standing = SetBench(simulator, series, {}).beside_noise({});
  const auto part = mean_over_rate(simulator.conditions(), *standing.fitter, standing.scenario);
  ASSERT_TRUE(part);
  const auto* mean = part->effect.as<effects::EmpiricalMeanOverRate>();
  ASSERT_NE(mean, nullptr);
  EXPECT_NEAR(mean->mean_1_dps - mean->mean_5_dps, 0.06, 0.01);
  EXPECT_NEAR(mean->mean_9_dps - mean->mean_5_dps, 0.06, 0.01);
  EXPECT_FALSE(mean_over_temperature(simulator.conditions(), *standing.fitter, standing.scenario));
}

/// A compass that wanders by half its noise over 20 s: 1200 s hold some thirty independent values,
/// of which the standard deviation is known to an eighth; within four of those, which chance leaves
/// once in 10,000 recordings.
TEST(Nameless, IsTheWanderOfACompass) {
  Scenario s = still();
  s.effects = {effects::EmpiricalCompassNoise{.innovation_std_deg = 0.3,
                                              .reflection_1 = 0.0,
                                              .wander_std_deg = 0.15,
                                              .wander_time_s = 20.0}};
  s.compass.noise_std_deg = 0.0;
  const auto parts = left_by_the_baseline(s, 4);
  ASSERT_EQ(parts.size(), 1);
  const auto value = [&](std::string_view name) {
    for (std::size_t f = 0; f < parts[0].effect.fields().size(); ++f)
      if (parts[0].effect.fields()[f].name == name) return parts[0].effect.value(f);
    return -1.0;
  };
  EXPECT_NEAR(value("innovation_std_deg"), 0.3, 0.01);
  EXPECT_NEAR(value("wander_std_deg"), 0.15, 0.15 * 4.0 / 8.0);
  EXPECT_THAT(parts[0].in_words, testing::HasSubstr("wander"));
}

/// An output filter, and a compass that filters: each by its spectrum alone.
TEST(Nameless, HasTheSpectrumOfWhatHasNoName) {
  Scenario s = still();
  s.effects = {effects::NoiseBandwidth{.cutoff_hz = 3.0, .poles = 2.0},
               effects::EmpiricalCompassNoise{.innovation_std_deg = 0.3, .reflection_1 = -0.5}};
  s.compass.noise_std_deg = 0.0;
  const auto parts = left_by_the_baseline(s, 3);
  ASSERT_EQ(parts.size(), 2);
  EXPECT_EQ(parts[0].effect.id(), "empirical_noise");
  EXPECT_EQ(parts[1].effect.id(), "empirical_compass_noise");
  EXPECT_NEAR(parts[1].effect.value(0), 0.3, 0.01);
  EXPECT_NEAR(parts[1].effect.value(1), -0.5, 0.03);
}

/// A burst at the end alone is handling; the same within is the sensor's.
TEST(Handling, IsABurstAtAnEndAlone) {
  Series series = recorded(still(), 4, false);
  EXPECT_EQ(handling_of(series).last_s, 0.0);
  const auto shaken = [&](std::size_t from) {
    Series s = series;
    for (std::size_t i = from; i < std::min(from + 30, s.size()); ++i)
      s.gyro_dps[i] += 5.0 * std::sin(1.3 * static_cast<double>(i));
    return s;
  };
  const auto at_the_end = handling_of(shaken(series.size() - 30));
  EXPECT_GE(at_the_end.last_s, 1.5);
  EXPECT_LE(at_the_end.last_s, 3.0);
  EXPECT_EQ(at_the_end.first_s, 0.0);
  EXPECT_GE(handling_of(shaken(0)).first_s, 1.5);
  EXPECT_EQ(handling_of(shaken(5000)).last_s, 0.0);
}

}  // namespace
}  // namespace gyrostat::gap::nameless_test
