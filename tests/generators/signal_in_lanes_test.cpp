#include <gyrostat/generators/packed/signal_in_lanes.hpp>

#include <algorithm>
#include <array>
#include <bit>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/shaking.hpp>
#include <gyrostat/generators/environment/motion/rate_table.hpp>
#include <gyrostat/generators/environment/temperature/cycle.hpp>

namespace gyrostat::signal_in_lanes_test {
namespace {

/// Turning, warming, disturbed twice at once; 500 samples are no whole number of stretches.
Scenario scenario() {
  Scenario made;
  made.sampling = {.duration_s = 50.0, .rate_hz = 10.0};
  made.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.1, .c_dps = -0.05};
  made.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 50.0, .period_s = 20.0};
  made.motion = motion::RateTable{};
  made.compass.noise_std_deg = 0.3;
  made.compass.initial_heading_deg = 179.0;
  made.compass.disturbances = {{.start_s = 20.0, .duration_s = 15.0},
                               {.start_s = 30.0, .duration_s = 5.0, .flagged = 0.0}};
  made.effects = {effects::ThermalHysteresis{}};
  return made;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void expect_the_series(const Scenario& scenario) {
  const auto conditions = shared_conditions(scenario);
  ASSERT_TRUE(conditions);
  const std::vector<Noise> trials = {{7, 3}, {7, 1}, {7, 4}};  // fewer than most packs have
  int compared = 0;
  for (const int lanes : {4, 8, 16}) {
    const auto* kernel = signal_kernel(lanes);
    if (kernel == nullptr) continue;
    SignalInLanes made(scenario, *conditions, trials, *kernel);
    const std::size_t samples = scenario.sampling.samples();
    std::vector<double> gyro(samples * lanes), random(samples * lanes), heading(samples * lanes);
    for (std::size_t k = 0; k < samples; k += signal_stretch) {
      const std::size_t some = std::min(signal_stretch, samples - k);
      made.gyro(k, some, &gyro[k * lanes], &random[k * lanes]);
      made.heading(k, some, &heading[k * lanes]);
    }
    for (std::size_t l = 0; l < static_cast<std::size_t>(lanes); ++l) {
      Series series;
      synthesise(scenario, trials[std::min<std::size_t>(l, 2)], series);
      for (std::size_t k = 0; k < samples; ++k, ++compared) {
        ASSERT_EQ(bits(gyro[k * lanes + l]), bits(series.gyro_dps[k])) << lanes << ", " << k;
        ASSERT_EQ(bits(random[k * lanes + l]), bits(series.random_error_dps[k])) << k;
        ASSERT_EQ(bits(heading[k * lanes + l]), bits(series.heading_deg[k])) << lanes << ", " << k;
        ASSERT_EQ(bits(conditions->series.thermal_bias_dps[k]), bits(series.thermal_bias_dps[k]));
        ASSERT_EQ(conditions->series.mag_valid[k], series.mag_valid[k]) << k;
      }
    }
  }
  if (signal_kernel(4) == nullptr) GTEST_SKIP() << "no kernels for this processor";
  EXPECT_GT(compared, 0);
}

TEST(SignalInLanes, HasTheBitsOfTheSeries) { expect_the_series(scenario()); }

TEST(SignalInLanes, HasThemWithoutNoise) {
  auto quiet = scenario();
  quiet.random_error.delta1_dps = quiet.random_error.delta2_dps = 0.0;
  quiet.random_error.measurement_noise_std_dps = 0.0;
  quiet.compass.noise_std_deg = 0.0;
  expect_the_series(quiet);
}

/// Given in another order than that in which they act.
TEST(SignalInLanes, HasThemThroughEffectsOnGyroAndCompass) {
  auto affected = scenario();
  affected.cross_motion_1 = motion::RateTable{};
  affected.acceleration = acceleration::Shaking{};
  affected.effects.emplace_back(effects::Quantization{.lsb_dps = 0.01});
  affected.effects.emplace_back(effects::Saturation{.limit_dps = 8.0});
  affected.effects.emplace_back(effects::ScaleTemperature{});
  affected.effects.emplace_back(effects::GSensitivity{});
  affected.effects.emplace_back(effects::Misalignment{});
  affected.effects.emplace_back(effects::HardIron{});
  affected.effects.emplace_back(effects::CompassLag{});
  expect_the_series(affected);
}

TEST(SignalInLanes, IsForTrialsThatDifferInNoiseAlone) {
  auto jumping = scenario();
  jumping.effects.emplace_back(effects::BiasSteps{});
  EXPECT_FALSE(shared_conditions(jumping));
  auto disturbed = scenario();
  disturbed.effects.emplace_back(effects::MagneticBursts{});
  EXPECT_FALSE(shared_conditions(disturbed));
  const std::vector<NoiseShare> shares = {{1, 0.6}, {2, 0.8}};
  EXPECT_FALSE(SignalInLanes::can_draw(std::vector<Noise>{{1, 1, shares}}));
  EXPECT_FALSE(SignalInLanes::can_draw(std::vector<Noise>{{1, 1}, {2, 1}}));
  EXPECT_TRUE(SignalInLanes::can_draw(std::vector<Noise>{{1, 1}, {1, 2}}));
}

/// Drawn from a stream, or from the trial's number without one.
struct OfTheTrial {
  double draws = 0.0;

  static constexpr std::string_view title = "a drift that differs from trial to trial";
  static constexpr Stage stage = Stage::sensing;
  static constexpr std::array needs = {&Series::thermal_bias_dps};

  static constexpr auto fields() {
    using P = OfTheTrial;
    return std::array{Field{"draws", &P::draws, "1", ranges::flag, "whether from a stream"}};
  }
  static constexpr OfTheTrial absent() { return {}; }

  void apply(Series& series, const Noise& noise) const {
    series.thermal_bias_dps[0] +=
        draws != 0.0 ? noise.stream("of_the_trial").normal(0) : static_cast<double>(noise.trial);
  }
};

TEST(SignalInLanes, ConditionsThatDependOnTheTrialAreNotShared) {
  const auto type = describe_effect<OfTheTrial>("of_the_trial");
  for (const double draws : {0.0, 1.0}) {
    auto differing = scenario();
    differing.effects.emplace_back(type);
    differing.effects.back().value(0) = draws;
    EXPECT_FALSE(shared_conditions(differing)) << draws;
  }
}

}  // namespace
}  // namespace gyrostat::signal_in_lanes_test
