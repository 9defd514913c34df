#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::motion_effects_test {
namespace {

/// The gyro of a noiseless sensor with this effect at these rates, 0.01 s apart.
template <class Effect>
std::vector<double> sensed(const Effect& effect, const std::vector<double>& rates) {
  auto series = silent(even_times(rates.size(), 100.0));
  series.rate_ref_dps = series.gyro_dps = rates;
  effect.apply(series, {1, 0});
  return series.gyro_dps;
}

TEST(ScaleFactor, AddsItsShareOfTheRate) {
  const auto z = sensed(effects::ScaleFactor{.error = 0.02}, {100.0, -50.0, 0.0});
  EXPECT_DOUBLE_EQ(z[0], 102.0);
  EXPECT_DOUBLE_EQ(z[1], -51.0);
  EXPECT_EQ(z[2], 0.0);
}

TEST(ScaleAsymmetry, AddsTheSameToBothDirections) {
  const auto z = sensed(effects::ScaleAsymmetry{.error = 0.02}, {100.0, -100.0, 0.0});
  EXPECT_DOUBLE_EQ(z[0], 102.0);
  EXPECT_DOUBLE_EQ(z[1], -98.0);
  EXPECT_EQ(z[2], 0.0);
}

TEST(SensorBandwidth, ApproachesAStepExponentially) {
  std::vector<double> step(101, 10.0);
  step[0] = 0.0;
  const auto z = sensed(effects::SensorBandwidth{.cutoff_hz = 2.0}, step);
  EXPECT_EQ(z[0], 0.0);
  for (std::size_t k = 1; k < step.size(); ++k)
    EXPECT_NEAR(z[k],
                10.0 * (1.0 - std::exp(-4.0 * std::numbers::pi * 0.01 * static_cast<double>(k))),
                1e-9);
}

/// Four hundred samples a period, so that holding the rate over an interval is within 1 %.
TEST(SensorBandwidth, HasHalfThePowerAtItsCutoff) {
  std::vector<double> sine;
  for (int i = 0; i < 4000; ++i) sine.push_back(std::sin(2.0 * std::numbers::pi * i / 400.0));
  const auto z = sensed(effects::SensorBandwidth{.cutoff_hz = 0.25}, sine);
  EXPECT_NEAR(mean_square({z.end() - 400, z.end()}), 0.25, 0.005);
}

TEST(SensorBandwidth, OfButterworthHasHalfThePowerAtItsCutoffAndAllAtRest) {
  std::vector<double> sine;
  for (int i = 0; i < 4000; ++i) sine.push_back(5.0 + std::sin(2.0 * std::numbers::pi * i / 400.0));
  const effects::SensorBandwidth two{.cutoff_hz = 0.25, .poles = 2.0, .maximally_flat = 1.0};
  auto z = sensed(two, sine);
  EXPECT_DOUBLE_EQ(z.front(), 5.0);
  for (double& value : z) value -= 5.0;
  EXPECT_NEAR(mean_square({z.end() - 400, z.end()}), 0.25, 0.005);
}

TEST(SensorBandwidth, OverUnevenIntervalsIsTheSameResponse) {
  auto series = silent({0.0, 0.1, 0.15, 0.9});
  series.rate_ref_dps = series.gyro_dps = {0.0, 5.0, 5.0, 5.0};
  effects::SensorBandwidth{.cutoff_hz = 1.0}.apply(series, {1, 0});
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(series.gyro_dps[i], 5.0 * (1.0 - std::exp(-2.0 * std::numbers::pi * series.t_s[i])),
                1e-12);
}

/// sin(pi f T) / (pi f T) = 1 / sqrt(2) at the cutoff f, and a ramp is late by half the time T.
TEST(SensorBandwidth, OfAMeanHasHalfThePowerAtItsCutoffAndIsLateByHalfItsTime) {
  std::vector<double> sine, ramp;
  for (int i = 0; i < 4000; ++i) sine.push_back(std::sin(2.0 * std::numbers::pi * i / 400.0));
  for (int i = 0; i < 400; ++i) ramp.push_back(0.1 * i);
  const effects::SensorBandwidth mean{.cutoff_hz = 0.25, .averages = 1.0};
  const auto z = sensed(mean, sine);
  EXPECT_NEAR(mean_square({z.end() - 400, z.end()}), 0.25, 1e-4);
  const double late_s = 0.5 * 0.44294647 / 0.25;
  const auto followed = sensed(mean, ramp);
  EXPECT_EQ(followed.front(), 0.0);
  EXPECT_NEAR(followed.back(), ramp.back() - 10.0 * late_s, 1e-9);
}

/// Over intervals that differ, of a rate that is straight between samples: exactly.
TEST(SensorBandwidth, OfAMeanOverUnevenIntervalsIsTheMean) {
  auto series = silent({0.0, 0.1, 0.15, 0.9, 1.0});
  series.rate_ref_dps = series.gyro_dps = {0.0, 1.0, 1.5, 9.0, 10.0};
  effects::SensorBandwidth{.cutoff_hz = 0.44294647 / 0.4, .averages = 1.0}.apply(series, {1, 0});
  EXPECT_NEAR(series.gyro_dps[3], 7.0, 1e-9);
  EXPECT_NEAR(series.gyro_dps[4], 8.0, 1e-9);
}

/// At s = 2 pi i f a pole has 1 / (1 + s / w), Butterworth's two w^2 / (s^2 + sqrt(2) w s + w^2),
/// his third 1 / (1 + s / w) more with a damping of 1. The cubic between samples is within 1e-3 of
/// a sine of a twentieth of the sampling rate.
TEST(SensorBandwidth, OfContinuousTimeHasTheResponseOfItsPoles) {
  using namespace std::complex_literals;
  struct Form {
    double poles, flat;
  };
  for (const Form form : {Form{1, 0}, Form{2, 0}, Form{3, 0}, Form{2, 1}, Form{3, 1}})
    for (const double cutoff_hz : {2.0, 8.0, 90.0})
      for (const double hz : {0.5, 2.0, 5.0}) {
        const effects::SensorBandwidth filter{.cutoff_hz = cutoff_hz,
                                              .poles = form.poles,
                                              .maximally_flat = form.flat,
                                              .continuous = 1.0};
        std::vector<double> sine;
        for (int i = 0; i < 2000; ++i)
          sine.push_back(std::sin(2.0 * std::numbers::pi * hz * 0.01 * i));
        const auto z = sensed(filter, sine);
        const std::complex<double> s = 1i * hz / cutoff_hz, pole = 1.0 / (1.0 + s);
        const std::complex<double> two =
            1.0 / (s * s + (form.poles == 2.0 ? std::numbers::sqrt2 : 1.0) * s + 1.0);
        std::complex<double> response = pole;
        if (form.flat == 1.0)
          response = form.poles == 2.0 ? two : two * pole;
        else
          response = std::pow(pole, form.poles);
        for (std::size_t i = 1500; i < 1990; ++i) {
          const auto turning =
              std::polar(1.0, 2.0 * std::numbers::pi * hz * 0.01 * static_cast<double>(i));
          ASSERT_NEAR(z[i], (response * turning).imag(), 1e-3)
              << form.poles << form.flat << cutoff_hz << ' ' << hz << ' ' << i;
        }
      }
}

/// Two poles of any damping; a cubic as close to its sine as above.
TEST(SensorBandwidth, OfSecondOrderHasTheResponseOfItsDamping) {
  using namespace std::complex_literals;
  for (const double damping : {0.4, 0.7, 1.0, 1.8})
    for (const double hz : {0.5, 2.0, 5.0}) {
      constexpr double natural_hz = 3.0;
      std::vector<double> sine;
      for (int i = 0; i < 2000; ++i)
        sine.push_back(std::sin(2.0 * std::numbers::pi * hz * 0.01 * i));
      const auto z =
          sensed(effects::SensorBandwidth{.cutoff_hz = natural_hz, .damping_ratio = damping}, sine);
      const std::complex<double> s = 1i * hz / natural_hz,
                                 response = 1.0 / (s * s + 2.0 * damping * s + 1.0);
      for (std::size_t i = 1500; i < 1990; ++i) {
        const auto turning =
            std::polar(1.0, 2.0 * std::numbers::pi * hz * 0.01 * static_cast<double>(i));
        ASSERT_NEAR(z[i], (response * turning).imag(), 1e-3) << damping << ' ' << hz << ' ' << i;
      }
    }
}

/// At rest at 3 dps more until a rate of 5 dps begins: one pole forgets it as exp(-w t),
/// Butterworth's two as exp(-u) (cos u + sin u), u = w t / sqrt(2), the mean in the time that it
/// goes over.
TEST(SensorBandwidth, ForgetsWhatWasBeforeTheFirstSample) {
  const std::vector<double> steady(400, 5.0);
  using Filter = effects::SensorBandwidth;
  const double w = 2.0 * std::numbers::pi * 0.5, over_s = 0.44294647 / 0.5;
  for (const auto& form :
       {Filter{.cutoff_hz = 0.5}, Filter{.cutoff_hz = 0.5, .continuous = 1.0},
        Filter{.cutoff_hz = 0.5, .poles = 2.0, .maximally_flat = 1.0, .continuous = 2.0},
        Filter{.cutoff_hz = 0.5, .averages = 1.0}}) {
    auto filter = form;
    filter.before_dps = 3.0;
    const auto z = sensed(filter, steady);
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double t = 0.01 * static_cast<double>(i), u = w * t / std::numbers::sqrt2;
      const double left = form.averages > 0.5 ? std::max(0.0, 1.0 - t / over_s)
                          : form.poles > 1.5  ? std::exp(-u) * (std::cos(u) + std::sin(u))
                                              : std::exp(-w * t);
      ASSERT_NEAR(z[i], 5.0 + 3.0 * left, 1e-9) << form.averages << form.poles << ' ' << i;
    }
  }
}

/// From the corner at which a rate begins to grow, one pole follows it as t - T (1 - exp(-t / T)):
/// exactly where the rate is straight between samples, and not where it is a cubic about them.
TEST(SensorBandwidth, OfAStraightRateFollowsACornerExactly) {
  std::vector<double> ramp;
  for (int i = 0; i < 200; ++i) ramp.push_back(std::max(0.0, 0.3 * (i - 100)));
  const auto straight = sensed(effects::SensorBandwidth{.cutoff_hz = 8.0, .continuous = 2.0}, ramp);
  const auto curved = sensed(effects::SensorBandwidth{.cutoff_hz = 8.0, .continuous = 1.0}, ramp);
  constexpr double T = 1.0 / (2.0 * std::numbers::pi * 8.0);
  for (std::size_t i = 100; i < 200; ++i) {
    const double t = 0.01 * (static_cast<double>(i) - 100.0);
    EXPECT_NEAR(straight[i], 30.0 * (t - T * -std::expm1(-t / T)), 1e-10);
  }
  EXPECT_GT(std::abs(curved[101] - straight[101]), 1e-3);
}

/// A ramp is late by 1 / w a pole, exactly; a rate that rests is as it is.
TEST(SensorBandwidth, OfContinuousTimeIsLateByItsPoles) {
  std::vector<double> ramp;
  for (int i = 0; i < 900; ++i) ramp.push_back(3.0 + std::max(0.0, 0.1 * (i - 100)));
  const auto z =
      sensed(effects::SensorBandwidth{.cutoff_hz = 3.0, .poles = 2.0, .continuous = 1.0}, ramp);
  for (std::size_t i = 0; i < 99; ++i) EXPECT_DOUBLE_EQ(z[i], 3.0);
  EXPECT_NEAR(z[800], ramp[800] - 10.0 * 2.0 / (2.0 * std::numbers::pi * 3.0), 1e-9);
}

/// A reference that was lost for a while leaves the filter what comes after it.
TEST(SensorBandwidth, BeginsAnewWhereTheRateWasMissing) {
  std::vector<double> rates(60, 5.0);
  for (std::size_t i = 20; i < 30; ++i) rates[i] = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 40; i < 60; ++i) rates[i] = 9.0;
  for (const auto& filter :
       {effects::SensorBandwidth{.cutoff_hz = 5.0},
        effects::SensorBandwidth{.cutoff_hz = 5.0, .poles = 2.0, .maximally_flat = 1.0},
        effects::SensorBandwidth{.cutoff_hz = 5.0, .continuous = 1.0},
        effects::SensorBandwidth{.cutoff_hz = 5.0, .averages = 1.0}}) {
    const auto z = sensed(filter, rates);
    EXPECT_NEAR(z[19], 5.0, 1e-12);
    for (std::size_t i = 20; i < 30; ++i) EXPECT_TRUE(std::isnan(z[i]));
    for (std::size_t i = 30; i < 39; ++i) EXPECT_NEAR(z[i], 5.0, 1e-12);
    EXPECT_GT(z[45], 6.0);
    EXPECT_NEAR(z[59], 9.0, 0.2);
  }
}

/// What a scale multiplies is the rate as it is sensed, wherever a scenario names it.
TEST(Scenario, OtherEffectsSeeTheRateAsItIsSensed) {
  Series conditions;
  for (int i = 0; i < 600; ++i) {
    conditions.t_s.push_back(0.01 * i);
    conditions.rate_ref_dps.push_back(20.0 * std::sin(0.05 * i));
    conditions.gyro_dps.push_back(0.0);
  }
  const auto shown = [&](std::vector<Effect> effects) {
    Scenario scenario;
    scenario.random_error = {
        .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
    scenario.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
    scenario.effects = std::move(effects);
    Series series;
    synthesise_under(scenario, conditions, {1, 0}, series);
    EXPECT_EQ(series.rate_ref_dps, conditions.rate_ref_dps);
    return series.gyro_dps;
  };
  const effects::SensorBandwidth slow{.cutoff_hz = 0.3};
  const effects::TimeOffset late{.offset_s = 0.05};
  const effects::ScaleFactor scale{.error = 0.1};
  const effects::DeadZone zone{.half_width_dps = 2.0};
  const auto filtered = shown({slow, late}), scaled = shown({scale, slow, late});
  for (std::size_t i = 0; i < filtered.size(); ++i)
    EXPECT_NEAR(scaled[i], 1.1 * filtered[i], 1e-12) << i;
  const auto cut = shown({scale, slow, zone});
  const auto alone = shown({slow});
  for (std::size_t i = 0; i < cut.size(); ++i)
    EXPECT_NEAR(cut[i], std::abs(alone[i]) <= 2.0 ? 0.0 : 1.1 * alone[i], 1e-12) << i;
}

TEST(Saturation, ClipsAtBothLimitsAndPassesWhatLiesBetweenAndGaps) {
  const auto z = sensed(effects::Saturation{.limit_dps = 30.0},
                        {29.0, 31.0, -31.0, -30.0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ((std::vector<double>(z.begin(), z.begin() + 4)),
            (std::vector<double>{29.0, 30.0, -30.0, -30.0}));
  EXPECT_TRUE(std::isnan(z[4]));
}

TEST(Saturation, MayHaveAnotherLimitBelowZero) {
  const auto z =
      sensed(effects::Saturation{.limit_dps = 30.0, .below_dps = 40.0}, {29.0, 31.0, -31.0, -41.0});
  EXPECT_EQ(z, (std::vector<double>{29.0, 30.0, -31.0, -40.0}));
}

/// From 36 to 44 a parabola, which has the slope of both sides at its ends.
TEST(Saturation, BendsIntoItsLimitOverItsKnee) {
  const auto z = sensed(effects::Saturation{.limit_dps = 40.0, .knee = 0.1},
                        {35.0, 36.0, 36.001, 40.0, -40.0, 43.999, 44.0, 90.0, -90.0});
  EXPECT_EQ(z[0], 35.0);
  EXPECT_EQ(z[1], 36.0);
  EXPECT_NEAR(z[2], 36.001, 1e-6);
  EXPECT_NEAR(z[3], 39.0, 1e-12);
  EXPECT_NEAR(z[4], -39.0, 1e-12);
  EXPECT_NEAR(z[5], 40.0, 1e-6);
  for (const std::size_t i : {6u, 7u}) EXPECT_NEAR(z[i], 40.0, 1e-12);
  EXPECT_EQ(z[8], -40.0);
}

TEST(Saturation, OfTheElementLeavesBiasAndNoise) {
  auto series = silent(even_times(3, 100.0));
  series.rate_ref_dps = {29.0, 31.0, -40.0};
  series.gyro_dps = {29.5, 31.5, -39.0};
  effects::Saturation{.limit_dps = 30.0, .of_element = 1.0}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{29.5, 30.5, -29.0}));
}

TEST(DeadZone, HidesRatesUpToItsHalfWidth) {
  EXPECT_EQ(sensed(effects::DeadZone{.half_width_dps = 0.5}, {0.5, -0.5, 0.3, 0.51, -0.51, 8.0}),
            (std::vector<double>{0.0, 0.0, 0.0, 0.51, -0.51, 8.0}));
}

TEST(DeadZone, MayTakeItsHalfWidthFromLargerRates) {
  EXPECT_EQ(
      sensed(effects::DeadZone{.half_width_dps = 0.5, .lost_beyond = 1.0}, {0.5, -0.5, 0.75, -8.0}),
      (std::vector{0.0, 0.0, 0.25, -7.5}));
}

TEST(DeadZone, MayEndElsewhereBelowZero) {
  EXPECT_EQ(sensed(effects::DeadZone{.half_width_dps = 0.5, .below_dps = 2.0},
                   {0.5, 0.51, -0.51, -2.0, -2.5}),
            (std::vector<double>{0.0, 0.51, 0.0, 0.0, -2.5}));
  EXPECT_EQ(sensed(effects::DeadZone{.half_width_dps = 0.5, .lost_beyond = 1.0, .below_dps = 2.0},
                   {0.75, -1.0, -2.5}),
            (std::vector<double>{0.25, 0.0, -0.5}));
}

/// The mean over a normal dither, by the midpoint rule.
TEST(DeadZone, IsRoundedByADither) {
  constexpr int steps = 20000;
  constexpr double reach = 8.0;
  for (const double lost : {0.0, 0.4, 1.0}) {
    const effects::DeadZone sharp{
        .half_width_dps = 0.5, .lost_beyond = lost, .below_dps = lost == 0.4 ? 0.8 : 0.0};
    auto rounded = sharp;
    rounded.dither = 0.3;
    for (const double rate : {0.0, 0.2, -0.45, 0.6, -3.0}) {
      std::vector<double> moved;
      for (int k = 0; k < steps; ++k)
        moved.push_back(rate + 0.15 * reach * ((2.0 * k + 1.0) / steps - 1.0));
      const auto each = sensed(sharp, moved);
      double mean = 0.0;
      for (std::size_t k = 0; k < each.size(); ++k) {
        const double z = (moved[k] - rate) / 0.15;
        mean += each[k] * std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi) * 2.0 * reach /
                steps;
      }
      EXPECT_NEAR(sensed(rounded, {rate})[0], mean, 1e-4) << lost << ' ' << rate;
    }
  }
}

TEST(DeadZone, LeavesBiasAndNoiseWhereTheyWere) {
  auto series = silent(even_times(2, 100.0));
  series.rate_ref_dps = {0.25, 0.0};
  series.gyro_dps = {0.75, 0.5};
  effects::DeadZone{.half_width_dps = 0.3}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{0.5, 0.5}));
}

TEST(DeadZone, OfTheOutputIsOfBiasAndNoise) {
  auto series = silent(even_times(4, 100.0));
  series.rate_ref_dps = {0.25, 0.0, 5.0, -5.0};
  series.gyro_dps = {0.75, -0.5, 5.5, -4.5};
  auto play = series;
  effects::DeadZone{.half_width_dps = 0.6, .of_output = 1.0}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{0.75, 0.0, 5.5, -4.5}));
  effects::DeadZone{.half_width_dps = 0.5, .lost_beyond = 1.0, .of_output = 1.0}.apply(play,
                                                                                       {1, 0});
  EXPECT_EQ(play.gyro_dps, (std::vector<double>{0.25, 0.0, 5.0, -4.0}));
}

TEST(ScaleAsymmetry, OfOneSideLeavesTheOther) {
  EXPECT_EQ(sensed(effects::ScaleAsymmetry{0.25, 1.0}, {4.0, -4.0}), (std::vector{6.0, -4.0}));
  EXPECT_EQ(sensed(effects::ScaleAsymmetry{0.25, -1.0}, {4.0, -4.0}), (std::vector{4.0, -2.0}));
  EXPECT_EQ(sensed(effects::ScaleAsymmetry{0.25}, {4.0, -4.0}), (std::vector{5.0, -3.0}));
}

TEST(GSensitivity, AddsEachAxisByItsCoefficient) {
  auto series = silent(even_times(2, 100.0));
  series.acc_x_mps2 = {1.0, 0.0};
  series.acc_y_mps2 = {2.0, 0.0};
  series.acc_z_mps2 = {9.0, -9.0};
  effects::GSensitivity{.x_dps_per_mps2 = 1.0, .y_dps_per_mps2 = 10.0, .z_dps_per_mps2 = 100.0}
      .apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{921.0, -900.0}));
}

/// Of a rate that is straight in time a shift is exact: 5 ms and 2 ms a second of 3 dps/s.
/// A compass on the gyro's board shows the heading of as much earlier; one elsewhere does not.
TEST(TimeOffset, IsTheCompassesWhereItHasTheClock) {
  Scenario scenario;
  scenario.sampling = {60.0, 20.0};
  scenario.motion = motion::RateTable{30.0, 10.0};
  scenario.compass.noise_std_deg = 0.0;
  Series true_to_time, series;
  synthesise(scenario, {1, 0}, true_to_time);
  for (const double of_compass : {0.0, 1.0}) {
    scenario.effects = {effects::TimeOffset{.offset_s = 0.2, .of_compass = of_compass}};
    synthesise(scenario, {1, 0}, series);
    const std::size_t late = of_compass > 0.5 ? 4 : 0;
    for (std::size_t i = 4; i < series.size(); ++i)
      EXPECT_NEAR(wrap_degrees(series.heading_deg[i] - true_to_time.heading_deg[i - late]), 0.0,
                  1e-9);
  }
}

TEST(TimeOffset, GrowsWithClocksOfUnlikePace) {
  std::vector<double> ramp;
  for (int i = 0; i < 500; ++i) ramp.push_back(0.03 * i);
  const auto z = sensed(effects::TimeOffset{.offset_s = 0.005, .drift_ppm = 2000.0}, ramp);
  for (std::size_t i = 10; i < 490; ++i)
    EXPECT_NEAR(z[i], ramp[i] - 3.0 * (0.005 + 0.002 * 0.01 * static_cast<double>(i)), 1e-9) << i;
  EXPECT_EQ(sensed(effects::TimeOffset{.offset_s = 0.0}, ramp), ramp);
}

TEST(ScaleTemperature, CurvesAboutItsReference) {
  auto series = silent(even_times(3, 100.0));
  series.rate_ref_dps = {100.0, 100.0, -10.0};
  series.temperature_C = {20.0, 30.0, 40.0};
  effects::ScaleTemperature{0.001, 30.0, 0.0002}.apply(series, {1, 0});
  EXPECT_NEAR(series.gyro_dps[0], 100.0 * (-0.01 + 0.02), 1e-12);
  EXPECT_EQ(series.gyro_dps[1], 0.0);
  EXPECT_NEAR(series.gyro_dps[2], -10.0 * (0.01 + 0.02), 1e-12);
}

TEST(EmpiricalResponse, IsASumOverNeighbours) {
  const std::vector<double> rates = {1.0, 5.0, -2.0, 7.0, 7.5, 3.0};
  const auto z = sensed(
      effects::EmpiricalResponse{
          .weight_1 = 0.5, .weight_4 = 0.0, .weight_5 = -1.0, .weight_6 = 2.0},
      rates);
  for (std::size_t i = 0; i < rates.size(); ++i)
    EXPECT_DOUBLE_EQ(z[i], rates[i] + 0.5 * rates[i < 4 ? 0 : i - 4] - rates[i] +
                               2.0 * rates[std::min(i + 1, rates.size() - 1)])
        << i;
}

/// What is missing counts as the sample itself, which weights that add up to nothing do not see.
TEST(EmpiricalResponse, KnowsNothingOfWhatIsMissing) {
  const auto z = sensed(effects::EmpiricalResponse{}, {4.0, 4.0, no_value, 4.0, 4.0});
  EXPECT_EQ(z[0], 4.0);
  EXPECT_EQ(z[1], 4.0);
  EXPECT_TRUE(std::isnan(z[2]));
  EXPECT_EQ(z[3], 4.0);
}

TEST(TimeOffset, OfWholeSamplesShiftsTheRateAndHoldsItsEnds) {
  const std::vector<double> rates = {1.0, 5.0, -2.0, 7.0, 7.5, 3.0};
  const auto late = sensed(effects::TimeOffset{.offset_s = 0.02}, rates);
  const auto early = sensed(effects::TimeOffset{.offset_s = -0.02}, rates);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    EXPECT_NEAR(late[i], rates[i < 2 ? 0 : i - 2], 1e-11) << i;
    EXPECT_NEAR(early[i], rates[std::min<std::size_t>(i + 2, 5)], 1e-11) << i;
  }
}

TEST(TimeOffset, OfAParabolaIsExactBetweenSamples) {
  std::vector<double> parabola;
  for (int i = 0; i < 100; ++i) parabola.push_back(0.01 * i * i);
  for (const double samples : {0.5, -0.3, 4.25}) {
    const auto z = sensed(effects::TimeOffset{.offset_s = 0.01 * samples}, parabola);
    for (int i = 10; i < 90; ++i) EXPECT_NEAR(z[i], 0.01 * std::pow(i - samples, 2), 1e-10) << i;
  }
}

TEST(TimeOffset, OfASineOfAnEighthOfTheSamplingRateIsWithinAPerCent) {
  std::vector<double> sine;
  const double turn = 2.0 * std::numbers::pi / 8.0;
  for (int i = 0; i < 200; ++i) sine.push_back(std::sin(turn * i));
  for (const double samples : {0.1, 0.25, 0.5, 0.8, -0.5, 7.4}) {
    const auto z = sensed(effects::TimeOffset{.offset_s = 0.01 * samples}, sine);
    for (int i = 20; i < 180; ++i)
      EXPECT_NEAR(z[i], std::sin(turn * (i - samples)), 0.01) << samples << " samples at " << i;
  }
}

TEST(TimeOffset, OverUnevenIntervalsFollowsAnEvenGrowth) {
  auto series = silent({0.0, 0.1, 0.15, 0.9, 1.0, 1.5});
  series.rate_ref_dps = series.gyro_dps = series.t_s;
  effects::TimeOffset{.offset_s = 0.07}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps[0], 0.0);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_NEAR(series.gyro_dps[i], series.t_s[i] - 0.07, 1e-12);
}

TEST(Misalignment, AddsItsShareOfEachOtherAxis) {
  auto series = silent(even_times(2, 100.0));
  series.cross_rate_1_dps = {100.0, 0.0};
  series.cross_rate_2_dps = {10.0, -10.0};
  effects::Misalignment{.share_1 = 0.02, .share_2 = -0.1}.apply(series, {1, 0});
  EXPECT_DOUBLE_EQ(series.gyro_dps[0], 1.0);
  EXPECT_DOUBLE_EQ(series.gyro_dps[1], 1.0);
}

TEST(ScaleTemperature, AddsItsShareOfTheRateForEachDegree) {
  auto series = silent(even_times(3, 100.0));
  series.rate_ref_dps = {100.0, 100.0, -50.0};
  series.temperature_C = {25.0, 35.0, 5.0};
  effects::ScaleTemperature{.scale_per_C = 1e-3, .reference_C = 25.0}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps[0], 0.0);
  EXPECT_DOUBLE_EQ(series.gyro_dps[1], 1.0);
  EXPECT_DOUBLE_EQ(series.gyro_dps[2], 1.0);
}

/// What vibration of this specific force along z adds, 0.1 s apart, with a time constant of 2 s.
std::vector<double> rectified(const std::vector<double>& acc_z_mps2) {
  auto series = silent(even_times(acc_z_mps2.size(), 10.0));
  series.acc_x_mps2.assign(series.size(), 3.0);
  series.acc_y_mps2.assign(series.size(), 0.0);
  series.acc_z_mps2 = acc_z_mps2;
  effects::VibrationRectification{.coefficient_dps_per_m2ps4 = 0.5, .time_constant_s = 2.0}.apply(
      series, {1, 0});
  return series.gyro_dps;
}

TEST(VibrationRectification, AtRestIsNothing) {
  for (const double bias : rectified(std::vector<double>(100, 9.8))) EXPECT_EQ(bias, 0.0);
}

/// With k = exp(-0.05) from sample to sample the mean of +-A is +-A (1 - k) / (1 + k).
TEST(VibrationRectification, OfAnEvenShakeIsInProportionToItsMeanSquare) {
  std::vector<double> shake;
  for (int i = 0; i < 1000; ++i) shake.push_back(9.8 + (i % 2 == 0 ? 3.0 : -3.0));
  const double k = std::exp(-0.05);
  EXPECT_NEAR(rectified(shake).back(), 0.5 * std::pow(3.0 * 2.0 * k / (1.0 + k), 2), 1e-9);
}

/// After a step A the deviation is A k^i, and its mean square A^2 k^(i + 1) (1 - k^i).
TEST(VibrationRectification, OfAStepIsForgotten) {
  std::vector<double> step(400, 11.8);
  step[0] = 9.8;
  const auto bias = rectified(step);
  const double k = std::exp(-0.05);
  for (int i = 0; i < 400; ++i)
    EXPECT_NEAR(bias[i], 0.5 * 4.0 * std::pow(k, i + 1) * (1.0 - std::pow(k, i)), 1e-12) << i;
}

/// With a mean that forgets by m a sample and squares that forget by k, the deviation after a step
/// A is A m^i and its mean square A^2 m^2 (1 - k) (m^2i - k^i) / (m^2 - k).
TEST(VibrationRectification, OfAStepIsForgottenByBothMeans) {
  auto series = silent(even_times(400, 10.0));
  series.acc_x_mps2.assign(series.size(), 0.0);
  series.acc_y_mps2.assign(series.size(), 0.0);
  series.acc_z_mps2.assign(series.size(), 11.8);
  series.acc_z_mps2[0] = 9.8;
  effects::VibrationRectification{
      .coefficient_dps_per_m2ps4 = 0.5, .time_constant_s = 0.5, .mean_time_constant_s = 8.0}
      .apply(series, {1, 0});
  const double k = std::exp(-0.2), m = std::exp(-0.0125);
  for (int i = 0; i < 400; ++i)
    EXPECT_NEAR(series.gyro_dps[i],
                0.5 * 4.0 * m * m * (1.0 - k) * (std::pow(m, 2 * i) - std::pow(k, i)) / (m * m - k),
                1e-12)
        << i;
}

/// The bias of ten seconds' shake is centred in time where the mean is, and a time constant later
/// where it looks back alone; both are less what the mean of the vibration takes to settle.
TEST(VibrationRectification, CentredWaitsForNothing) {
  for (const double centred : {0.0, 1.0}) {
    auto series = silent(even_times(1000, 10.0));
    series.acc_x_mps2.assign(series.size(), 0.0);
    series.acc_y_mps2.assign(series.size(), 0.0);
    for (std::size_t i = 0; i < series.size(); ++i)
      series.acc_z_mps2.push_back(9.8 + (i / 100 != 4 ? 0.0 : i % 2 == 0 ? 3.0 : -3.0));
    effects::VibrationRectification{
        .coefficient_dps_per_m2ps4 = 0.5, .time_constant_s = 2.0, .centred = centred}
        .apply(series, {1, 0});
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      sum += series.gyro_dps[i];
      moment += series.t_s[i] * series.gyro_dps[i];
    }
    EXPECT_NEAR(moment / sum, 45.0 + (centred > 0.5 ? 0.0 : 2.0), 0.2) << centred;
  }
}

/// Of two stretches, each in proportion to its own mean square from its first sample on.
TEST(VibrationRectification, BetweenItsChangesKeepsToALevel) {
  auto series = silent(even_times(4000, 50.0));
  series.acc_x_mps2.assign(series.size(), 0.0);
  series.acc_y_mps2.assign(series.size(), 0.0);
  const NormalStream noise(5, 0, "shaker");
  for (std::size_t i = 0; i < series.size(); ++i)
    series.acc_z_mps2.push_back(9.8 + (i < 1500 ? 1.0 : 4.0) * noise.normal(i));
  effects::VibrationRectification{0.01, 2.0, 1.0}.apply(series, {1, 0});
  const double before = series.gyro_dps[1480], after = series.gyro_dps[1520];
  EXPECT_NEAR(before, 0.01, 0.01 * 5.0 * std::sqrt(2.0 / 1500.0));
  EXPECT_NEAR(after, 0.16, 0.16 * 5.0 * std::sqrt(2.0 / 2500.0));
  // The first seconds are those of a mean that is not known yet.
  for (std::size_t i = 200; i < 1480; ++i) ASSERT_EQ(series.gyro_dps[i], before) << i;
  for (std::size_t i = 1520; i < series.size(); ++i) ASSERT_EQ(series.gyro_dps[i], after) << i;
}

/// What the effect adds to the drift at these temperatures, 1 s apart.
std::vector<double> lag(const effects::ThermalLag& effect,
                        const std::vector<double>& temperature_C) {
  auto series = silent(even_times(temperature_C.size(), 1.0));
  series.temperature_C = temperature_C;
  effect.apply(series, {1, 0});
  return series.thermal_bias_dps;
}

TEST(ThermalLag, DecaysAfterAStepWithItsTimeConstant) {
  std::vector<double> step(61, 30.0);
  step[0] = 20.0;
  const auto bias = lag({.sensitivity_dps_per_C = 0.01, .time_constant_s = 20.0}, step);
  EXPECT_EQ(bias[0], 0.0);
  for (std::size_t k = 1; k < step.size(); ++k)
    EXPECT_NEAR(bias[k], -0.1 * std::exp(-static_cast<double>(k) / 20.0), 1e-14);
}

/// Of k equal poles after a step exp(-x) (1 + x + ... ), x in time constants of one, is left to
/// follow.
TEST(ThermalLag, OfTwoPolesAddsTheirTimeConstants) {
  std::vector<double> step(61, 30.0);
  step[0] = 20.0;
  const auto bias =
      lag({.sensitivity_dps_per_C = 0.01, .time_constant_s = 40.0, .poles = 2.0}, step);
  // Held over intervals of 1 s, of which both poles keep r = exp(-1 / 20): k r^k (1 - r) + r^k.
  const double r = std::exp(-1.0 / 20.0);
  for (std::size_t k = 1; k < step.size(); ++k) {
    const auto n = static_cast<double>(k);
    EXPECT_NEAR(bias[k], -0.1 * std::pow(r, n) * (1.0 + n * (1.0 - r)), 1e-14) << k;
  }
}

/// At a constant temperature, of which the masses know nothing at first.
TEST(ThermalLag, MayBeginAwayFromItsTemperature) {
  const std::vector<double> even(61, 30.0);
  const auto one =
      lag({.sensitivity_dps_per_C = 0.0, .time_constant_s = 20.0, .start_dps = 0.02}, even);
  const auto two =
      lag({.sensitivity_dps_per_C = 0.0, .time_constant_s = 40.0, .poles = 2.0, .start_dps = 0.02},
          even);
  const double r = std::exp(-1.0 / 20.0);
  for (std::size_t k = 0; k < even.size(); ++k) {
    const auto n = static_cast<double>(k);
    EXPECT_NEAR(one[k], 0.02 * std::pow(r, n), 1e-15) << k;
    EXPECT_NEAR(two[k], 0.02 * std::pow(r, n) * (1.0 + n * (1.0 - r)), 1e-15) << k;
  }
}

/// Each interval the lag grows by the rise D and decays: e = exp(-1/20) (e + D), about 19.5 D.
TEST(ThermalLag, BehindAnEvenRampIsConstant) {
  std::vector<double> ramp;
  for (int i = 0; i < 1000; ++i) ramp.push_back(20.0 + 0.01 * i);
  const auto bias = lag({.sensitivity_dps_per_C = 0.01, .time_constant_s = 20.0}, ramp);
  EXPECT_NEAR(bias.back(), -0.01 * 0.01 / std::expm1(1.0 / 20.0), 1e-14);
  EXPECT_NEAR(bias.back(), bias[900], 1e-12);
}

TEST(ThermalLag, AtConstantTemperatureIsNothing) {
  for (const double b : lag({}, std::vector<double>(100, 55.0))) EXPECT_EQ(b, 0.0);
}

}  // namespace
}  // namespace gyrostat::motion_effects_test
