#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::sensor_bandwidth_test {
namespace {

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

}  // namespace
}  // namespace gyrostat::sensor_bandwidth_test
