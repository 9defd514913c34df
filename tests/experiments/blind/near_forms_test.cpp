// Forms near an effect's own: what each does to a signal, in closed form.

#include <gyrostat/experiments/blind/near_forms.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/experiments/blind/forms/filtered_output.hpp>
#include <gyrostat/experiments/blind/forms/heavy_tails.hpp>
#include <gyrostat/experiments/blind/forms/one_sided_scale.hpp>
#include <gyrostat/experiments/blind/forms/output_dead_zone.hpp>
#include <gyrostat/experiments/blind/forms/second_order_compass.hpp>
#include <gyrostat/experiments/blind/forms/second_order_lag.hpp>
#include <gyrostat/experiments/blind/forms/truncation.hpp>

namespace gyrostat::gap {
namespace {

Series at_10_hz(std::size_t samples) {
  Series series;
  for (std::size_t i = 0; i < samples; ++i) series.t_s.push_back(0.1 * static_cast<double>(i));
  for (auto channel : {&Series::gyro_dps, &Series::rate_ref_dps, &Series::thermal_bias_dps,
                       &Series::random_error_dps, &Series::temperature_C, &Series::heading_deg})
    (series.*channel).assign(samples, 0.0);
  return series;
}

TEST(NearForms, AreFormsOfTheirEffectsAlone) {
  EXPECT_EQ(near_form("truncation", "quantization", "here").type.id, "truncation");
  EXPECT_THROW(near_form("truncation", "outliers", "here"), InputError);
  EXPECT_THROW(near_form("truncatio", "quantization", "here"), InputError);
}

TEST(NearForms, FilteredOutputPassesRateAndNoiseAlike) {
  auto series = at_10_hz(50);
  for (std::size_t i = 1; i < 50; ++i) series.gyro_dps[i] = 1.0;
  forms::FilteredOutput{.cutoff_hz = 0.5}.apply(series, {});
  for (std::size_t i = 0; i < 50; ++i)
    EXPECT_NEAR(series.gyro_dps[i], 1.0 - std::exp(-M_PI * series.t_s[i]), 1e-12);
}

TEST(NearForms, SecondOrderLagStartsWithoutASlope) {
  auto series = at_10_hz(2000);
  for (std::size_t i = 1; i < 2000; ++i) series.temperature_C[i] = 1.0;  // a step
  forms::SecondOrderLag{.sensitivity_dps_per_C = 1.0, .time_constant_s = 20.0}.apply(series, {});
  for (const std::size_t i : {1u, 100u, 500u}) {  // both masses have 10 s: -(1 + t/10) exp(-t/10)
    const double ratio = series.t_s[i] / 10.0;
    EXPECT_NEAR(series.thermal_bias_dps[i], -(1.0 + ratio) * std::exp(-ratio), 0.01);
  }
}

TEST(NearForms, SecondOrderCompassTrailsARampByItsTimeConstant) {
  auto series = at_10_hz(1000);
  for (std::size_t i = 0; i < 1000; ++i) series.heading_deg[i] = 3.0 * series.t_s[i];
  forms::SecondOrderCompass{.time_constant_s = 2.0}.apply(series, {});
  EXPECT_NEAR(series.heading_deg[999], 3.0 * series.t_s[999] - 6.0, 1e-6);
}

TEST(NearForms, OneSidedScaleLeavesTheOtherSide) {
  auto series = at_10_hz(2);
  series.rate_ref_dps = {50.0, -50.0};
  forms::OneSidedScale{.error = 0.01}.apply(series, {});
  EXPECT_THAT(series.gyro_dps, testing::ElementsAre(0.5, 0.0));
}

TEST(NearForms, TruncationAndDeadZoneWriteZero) {
  auto series = at_10_hz(4);
  series.gyro_dps = {0.19, -0.19, 0.05, 0.31};
  forms::Truncation{.lsb_dps = 0.1}.apply(series, {});
  EXPECT_THAT(series.gyro_dps,
              testing::Pointwise(testing::DoubleNear(1e-12), {0.1, -0.1, 0.0, 0.3}));
  forms::OutputDeadZone{.half_width_dps = 0.2}.apply(series, {});
  EXPECT_THAT(series.gyro_dps,
              testing::Pointwise(testing::DoubleNear(1e-12), {0.0, 0.0, 0.0, 0.3}));
}

TEST(NearForms, HeavyTailsAreStudents) {
  auto series = at_10_hz(100000);
  const NormalStream white(1, 0, "white");
  white.fill(0, series.gyro_dps);
  forms::HeavyTails{.degrees_of_freedom = 3}.apply(series, {1, 0});
  double beyond = 0;  // |t_3| > 5.841 in 1 %, a normal deviate never
  for (const double z : series.gyro_dps) beyond += std::abs(z) > 5.841;
  EXPECT_NEAR(beyond / 1e5, 0.01, 0.001);
}

}  // namespace
}  // namespace gyrostat::gap
