#include <gyrostat/analysis/fits/thermal_regression.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::thermal_regression_test {
namespace {

Scenario warm_up(double delta_dps) {
  Scenario scenario;
  scenario.sampling = {.duration_s = 2000.0, .rate_hz = 5.0};
  scenario.thermal_drift = {0.003, 0.2, -0.1};
  scenario.temperature =
      temperature::RampAndCooling{.ramp_s = 700.0, .cooling_time_constant_s = 400.0};
  scenario.random_error = {0.0, delta_dps, 0.0, 0.02};
  return scenario;
}

TEST(ThermalRegression, IsExactOnALinearDriftWithoutNoise) {
  Scenario scenario = warm_up(0.0);
  scenario.random_error.measurement_noise_std_dps = 0.0;
  scenario.thermal_drift.b_dps_s_per_C = 0.0;
  // The mean of a T over an interval differs from a T at its end by a T' dt / 2, which b takes on.
  Series series;
  synthesise(scenario, {1, 0}, series);
  const auto fit = fit_thermal_drift(series);
  EXPECT_NEAR(fit.parameters.a_dps_per_C, 0.003, 1e-6);
  EXPECT_NEAR(fit.parameters.c_dps, -0.1, 5e-5);
  EXPECT_NEAR(fit.parameters.b_dps_s_per_C, -0.003 * 10.0 / 2, 1e-3);
}

struct Errors {
  double coverage;  ///< share of runs whose 95 % interval holds the true a
  double stated;    ///< mean standard error over the errors' root mean square
};

Errors errors_of_a(double delta_dps, int runs) {
  Series series;
  double covered = 0.0, stated = 0.0, squares = 0.0;
  for (int trial = 0; trial < runs; ++trial) {
    synthesise(warm_up(delta_dps), {7, static_cast<std::uint32_t>(trial)}, series);
    const auto fit = fit_thermal_drift(series);
    const double off = fit.parameters.a_dps_per_C - 0.003, error = fit.standard_errors.a_dps_per_C;
    covered += std::abs(off) < 1.96 * error ? 1.0 : 0.0;
    stated += error;
    squares += off * off;
  }
  return {covered / runs, stated / runs / std::sqrt(squares / runs)};
}

// 300 runs: the standard error of a coverage of 0.95 is 0.0126; 0.90-0.99 lies 3-4 of them away,
// and the root mean square of 300 errors is known to 4 %.

// Two hundred rows cannot exclude a small walk, and the intervals allow for it: too wide, not too
// narrow, and not by a factor of two.
TEST(ThermalRegression, AllowsForAWalkThatItCannotExclude) {
  const auto [coverage, stated] = errors_of_a(0.0, 300);
  EXPECT_GE(coverage, 0.93);
  EXPECT_GT(stated, 1.0);
  EXPECT_LT(stated, 2.0);
}

TEST(ThermalRegression, KnowsItsErrorsWhenTheResidualWanders) {
  const auto [coverage, stated] = errors_of_a(0.0005, 300);
  EXPECT_GE(coverage, 0.90);
  EXPECT_LE(coverage, 0.99);
  EXPECT_NEAR(stated, 1.0, 0.2);
}

TEST(ThermalRegression, DoesNotJudgeATemperatureThatStandsStill) {
  Scenario scenario = warm_up(0.0);
  scenario.temperature = temperature::QuietRoom{.start_C = 25.0, .end_C = 25.5};
  Series series;
  synthesise(scenario, {1, 0}, series);
  const auto fit = fit_thermal_drift(series);
  EXPECT_EQ(fit.parameters.a_dps_per_C, 0.0);
  EXPECT_TRUE(std::isinf(fit.standard_errors.a_dps_per_C));
  EXPECT_THAT(fit.message, testing::HasSubstr("not assessable"));
}

/// Root of a mean over trials of a product of near-Gaussian differences; 3 % is five of its
/// standard errors. A gyro that wanders and a drift that is not linear do not add to it.
TEST(CompassNoise, IsRecoveredFromASensorThatWanders) {
  Scenario scenario = warm_up(2e-4);
  scenario.effects = {effects::ThermalCurvature{.curvature_dps_per_C2 = 5e-5}};
  for (const double noise : {0.05, 0.2}) {
    scenario.compass.noise_std_deg = noise;
    double squares = 0.0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
      Series series;
      synthesise(scenario, {1, static_cast<std::uint32_t>(trial)}, series);
      const auto fit = fit_thermal_drift(series);
      const double found = compass_noise_std(series, fit.parameters);
      squares += found * found / trials;
    }
    EXPECT_NEAR(std::sqrt(squares) / noise, 1.0, 0.03) << noise;
  }
}

TEST(CompassNoise, OfNoCompassIsNoValue) {
  Series series;
  synthesise(warm_up(0.0), {1, 0}, series);
  series.heading_deg.clear();
  EXPECT_TRUE(std::isnan(compass_noise_std(series, {})));
}

TEST(ThermalRegression, NeedsFourIntervals) {
  Scenario scenario = warm_up(0.0);
  scenario.sampling.duration_s = 35.0;
  Series series;
  synthesise(scenario, {1, 0}, series);
  EXPECT_THROW((void)fit_thermal_drift(series), InputError);
}

}  // namespace
}  // namespace gyrostat::thermal_regression_test
