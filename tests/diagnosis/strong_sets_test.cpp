// Strong sets by likelihood, found whole. Processes of long memory take twice as long to show.

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::strong_sets_test {
namespace {

struct Known {
  std::string name;
  std::vector<Effect> effects;
  bool moves = false;
  double duration_s = ten_minutes_s;
};

class StrongSet : public testing::TestWithParam<Known> {};

TEST_P(StrongSet, IsFoundWhole) {
  const double duration_s = GetParam().duration_s;
  Scenario s = GetParam().moves ? moving(duration_s) : still(duration_s);
  s.effects = GetParam().effects;
  std::set<std::string> expected;
  for (const auto& effect : s.effects) expected.emplace(effect.id());
  EXPECT_EQ(found_in(recorded(s, 77, GetParam().moves)), expected);
}

INSTANTIATE_TEST_SUITE_P(
    SetSearch, StrongSet,
    testing::Values(
        Known{"noise",
              {effects::NoiseBandwidth{2.0}, effects::Vibration{0.04, 4.0, 0.4},
               effects::Outliers{0.005, 0.5}}},
        Known{"slow",
              {effects::GaussMarkov{0.02, 15.0}, effects::ThermalCurvature{6e-4, 40.0},
               effects::StaleSamples{0.05, 1.0}},
              false,
              twenty_minutes_s},
        Known{"red",
              {effects::BiasInstability{.coefficient_dps = 0.03},
               effects::Sinusoidal{.amplitude_dps = 0.02, .frequency_hz = 0.3}}},
        Known{"hump",
              {effects::WanderingLine{.amplitude_dps = 0.08,
                                      .frequency_hz = 6.0,
                                      .wander_hz = 0.4,
                                      .correlation_time_s = 2.0},
               effects::Sinusoidal{.amplitude_dps = 0.01, .frequency_hz = 1.3}}},
        Known{"levels",
              {effects::Telegraph{0.03, 40.0}, effects::Quantization{0.1},
               effects::NoiseTemperature{0.03}}},
        Known{"stairs", {effects::BiasSteps{20.0, 0.1}, effects::ThermalHysteresis{0.08, 3.0}}},
        Known{"filtered",
              {effects::NoiseBandwidth{2.0, 2.0, 1.0}, effects::GaussMarkov{0.02, 15.0},
               effects::RateRamp{5e-4}},
              false,
              twenty_minutes_s},
        Known{"sampled",
              {effects::NoiseBandwidth{
                   .cutoff_hz = 7.0, .poles = 2.0, .maximally_flat = 1.0, .continuous = 1.0},
               effects::GaussMarkov{0.02, 15.0}},
              false,
              twenty_minutes_s},
        Known{"angle",
              {effects::NoiseBandwidth{5.0, 2.0, 1.0},
               effects::AngleQuantization{.coefficient_deg = 8e-4},
               effects::Vibration{0.02, 4.0, 0.4}, effects::BiasSteps{20.0, 0.15}}},
        Known{"spikes",
              {effects::NoiseAveraging{2.5, 1.0}, effects::Outliers{0.002, 0.3},
               effects::Sinusoidal{.amplitude_dps = 0.02, .frequency_hz = 0.3}}},
        Known{"averaged",
              {effects::NoiseAveraging{2.5, 1.0}, effects::Vibration{0.04, 4.0, 0.4},
               effects::ScaleAsymmetry{0.0015}},
              true},
        Known{"iron",
              {effects::HardIron{6.0, 40.0, 1.0}, effects::SoftIron{3.0, 10.0, 1.0},
               effects::CompassLag{.time_constant_s = 0.5, .of_field = 1.0}},
              true},
        Known{"side", {effects::ScaleAsymmetry{0.003, -1.0}, effects::HardIron{1.0, 40.0}}, true},
        Known{"silence",
              {effects::DeadZone{.half_width_dps = 2.0, .of_output = 1.0},
               effects::ScaleFactor{0.003}},
              true},
        Known{"late",
              {effects::DeadZone{.half_width_dps = 2.0, .of_output = 1.0},
               effects::SensorBandwidth{.cutoff_hz = 0.5}},
              true},
        Known{"play",
              {effects::DeadZone{.half_width_dps = 2.0, .lost_beyond = 1.0, .of_output = 1.0},
               effects::NoiseAveraging{2.5, 1.0}},
              true},
        Known{"broad",
              {effects::WanderingLine{.amplitude_dps = 0.1,
                                      .frequency_hz = 5.5,
                                      .wander_hz = 0.5,
                                      .correlation_time_s = 10.0},
               effects::GaussMarkov{0.02, 15.0}},
              false,
              twenty_minutes_s},
        Known{"sweep",
              {effects::WanderingLine{.amplitude_dps = 0.02,
                                      .frequency_hz = 6.0,
                                      .wander_hz = 0.6,
                                      .correlation_time_s = 60.0},
               effects::BiasSteps{20.0, 0.1}}},
        Known{
            "gradual",
            {effects::ThermalHysteresis{0.08, 5.0, 1.0, 1.0}, effects::Vibration{0.04, 4.0, 0.4}}},
        Known{"cubic",
              {effects::ThermalCurvature{6e-4, 40.0, 5e-5},
               effects::NoiseTemperature{0.0, 40.0, 2e-3}, effects::StaleSamples{0.05, 1.0}}},
        Known{"mean",
              {effects::SensorBandwidth{.cutoff_hz = 0.5, .averages = 1.0},
               effects::ScaleFactor{0.01}},
              true},
        Known{"clocks",
              {effects::TimeOffset{.offset_s = 0.05, .drift_ppm = 60.0},
               effects::ScaleAsymmetry{0.003, 1.0}, effects::GaussMarkov{0.02, 15.0}},
              true,
              twenty_minutes_s},
        Known{"motion",
              {effects::ScaleFactor{0.01}, effects::SensorBandwidth{1.0},
               effects::HardIron{5.0, 40.0}},
              true}),
    [](const auto& known) { return known.param.name; });

}  // namespace
}  // namespace gyrostat::gap::strong_sets_test
