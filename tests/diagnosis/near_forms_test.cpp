// Effects in forms that other sensors have them in: each is one effect, under its own name.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::near_forms_test {
namespace {

/// What is found in a recording.
struct Found {
  explicit Found(const Series& series)
      : simulator(series, 1), set(find_set(simulator, series, {})) {}

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& member : set.members) all.insert(member.effect);
    return all;
  }
  /// The first effect, as the one that it should be.
  template <class E>
  const E& first() const {
    return *set.scenario.effects.front().as<E>();
  }

  Simulator simulator;
  FoundSet set;
};

/// A filter and the converter's noise after it: four poles, a broad line and a second filter stood
/// in for them.
TEST(NearForms, FilteredNoiseWithWhiteNoiseAfterItIsOneEffect) {
  Scenario s = still();
  s.random_error.measurement_noise_std_dps = 0.1;
  s.effects = {effects::NoiseBandwidth{
      .cutoff_hz = 2.5, .poles = 2.0, .maximally_flat = 1.0, .after_dps = 0.012}};
  const Series series = recorded(s, 61, false);
  const Found found(series);
  EXPECT_EQ(found.names(), std::set<std::string>{"noise_bandwidth"});
  const auto& effect = found.first<effects::NoiseBandwidth>();
  EXPECT_NEAR(effect.cutoff_hz, 2.5, 0.05);
  // Of some 10,000 values above the cutoff: 5 standard errors.
  EXPECT_NEAR(effect.after_dps, 0.012, 5.0 * 0.012 / std::sqrt(2.0 * 10000.0));
}

/// Butterworth's of third order: one of fourth order, an average and lines stood in for it. So far
/// above its cutoff the memory of a random error would show, which is not what this is about.
TEST(NearForms, AFilterOfThreePolesIsOneEffect) {
  Scenario s = still();
  s.random_error.phi = 0.0;
  s.random_error.delta1_dps = 1e-4;
  s.random_error.delta2_dps = 0.0;
  s.effects = {effects::NoiseBandwidth{.cutoff_hz = 1.9, .poles = 3.0, .maximally_flat = 1.0}};
  const Found found(recorded(s, 82, false));
  ASSERT_EQ(found.names(), std::set<std::string>{"noise_bandwidth"});
  EXPECT_EQ(found.first<effects::NoiseBandwidth>().poles, 3.0);
}

TEST(NearForms, ALineWithAHarmonicIsOneEffect) {
  Series series = recorded(still(ten_minutes_s), 62, false);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double turn = 2.0 * std::numbers::pi * 3.1 * series.t_s[i];
    series.gyro_dps[i] += 0.02 * std::sin(turn) + 0.006 * std::sin(2.0 * turn + 1.0);
  }
  EXPECT_EQ(Found(series).names(), std::set<std::string>{"sinusoidal"});
}

/// An arm that turns is accelerated as it turns: the scale of its rate stood in for what is felt
/// along one axis, beside what is felt along another.
TEST(NearForms, WhatIsFeltAlongThreeAxesNeedsNoScale) {
  Scenario s = moving(ten_minutes_s);
  s.acceleration = acceleration::Level{};
  Series series = recorded(s, 63, true);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double rate = series.rate_ref_dps[i];
    series.acc_x_mps2[i] = 3.0 * std::sin(0.05 * series.t_s[i]);
    series.acc_y_mps2[i] = 0.05 * rate + 0.3 * std::sin(0.7 * series.t_s[i]);
    series.gyro_dps[i] += 0.02 * series.acc_x_mps2[i] + 0.04 * series.acc_y_mps2[i];
  }
  EXPECT_EQ(Found(series).names(), std::set<std::string>{"g_sensitivity"});
}

/// What a shaker does within a cluster of samples no mean of it shows: 5 m/s² at 4.3 Hz, of which
/// the gyro feels a tenth of its noise.
TEST(NearForms, WhatIsFeltOfAShakerAloneIsFound) {
  Scenario s = still();
  s.sampling.duration_s = 600.0;
  s.temperature = temperature::QuietRoom{.start_C = 38.0, .end_C = 40.0};
  s.acceleration = acceleration::Shaking{.amplitude_mps2 = 5.0, .frequency_hz = 4.3};
  s.effects = {effects::GSensitivity{.x_dps_per_mps2 = 0.0, .z_dps_per_mps2 = 0.0018}};
  const Found found(recorded(s, 68, false));
  EXPECT_EQ(found.names(), std::set<std::string>{"g_sensitivity"});
  // Of 9,000 samples of the half that is searched half are shaken, by 5 / sqrt(2): 5 standard
  // errors.
  EXPECT_NEAR(found.first<effects::GSensitivity>().z_dps_per_mps2, 0.0018,
              5.0 * 0.05 / (5.0 / std::numbers::sqrt2 * std::sqrt(4500.0)));
}

/// At 12.5 Hz a process of 1.4 s forgets within 18 samples, and is no filter: the white noise is
/// the stronger, and has one of its own.
TEST(NearForms, AGaussMarkovProcessOfFewSamplesIsOne) {
  Scenario s = still();
  s.sampling.rate_hz = 12.5;
  s.random_error.measurement_noise_std_dps = 0.1;
  s.effects = {effects::NoiseBandwidth{.cutoff_hz = 4.0, .poles = 2.0, .maximally_flat = 1.0},
               effects::GaussMarkov{0.04, 1.4}};
  EXPECT_EQ(Found(recorded(s, 69, false)).names(),
            (std::set<std::string>{"gauss_markov", "noise_bandwidth"}));
}

/// It had no name, or steps, settling and an angle's errors stood in for it.
TEST(NearForms, AProcessOfSecondOrderIsAGaussMarkovProcess) {
  Scenario s = still();
  s.effects = {effects::GaussMarkov{.std_dps = 0.03, .correlation_time_s = 8.0, .order = 2.0}};
  const Found found(recorded(s, 85, false));
  ASSERT_EQ(found.names(), std::set<std::string>{"gauss_markov"});
  const auto& process = found.first<effects::GaussMarkov>();
  EXPECT_EQ(process.order, 2.0);
  // Some 600 s hold 75 correlation times: 5 standard errors.
  EXPECT_NEAR(process.std_dps / 0.03, 1.0, 5.0 / std::sqrt(2.0 * 75.0));
}

/// What a third of a degree moves the bias by is the baseline's own drift: a ramp, or the memory of
/// a slow error, stood in for it.
TEST(NearForms, TheDriftOfARoomIsNoEffect) {
  Scenario s = still();
  s.temperature = temperature::QuietRoom{.start_C = 25.0, .end_C = 25.3};
  s.random_error.delta1_dps = s.random_error.delta2_dps = 1e-6;
  s.thermal_drift.a_dps_per_C = 0.15;
  EXPECT_EQ(Found(recorded(s, 89, false)).names(), std::set<std::string>{});
}

/// Of two slopes: steps of the bias and a memory stood in for them.
TEST(NearForms, AKinkOverTemperatureIsACurvature) {
  Scenario s = still();
  s.effects = {effects::ThermalCurvature{
      .curvature_dps_per_C2 = 0.0, .kink_dps_per_C = 0.004, .kink_C = 33.0}};
  const Found found(recorded(s, 86, false));
  ASSERT_EQ(found.names(), std::set<std::string>{"thermal_curvature"});
  const auto& kink = found.first<effects::ThermalCurvature>();
  EXPECT_EQ(kink.curvature_dps_per_C2, 0.0);
  EXPECT_NEAR(kink.kink_C, 33.0, 1.5);
}

/// Clipped with its bias of 0.25 dps, and noise comes after: without the bias, the limits differ by
/// twice as much. Telegraph noise and steps stood in for it.
TEST(NearForms, LimitsOfBothSidesNeedNotBeAlike) {
  Scenario s = moving();
  s.effects = {effects::Saturation{.limit_dps = 69.75, .of_element = 1.0, .below_dps = 70.25}};
  const Found found(recorded(s, 88, true));
  ASSERT_EQ(found.names(), std::set<std::string>{"saturation"});
  const auto& limit = found.first<effects::Saturation>();
  // Of 14,400 samples of the train part a sixth are at each limit: 5 standard errors.
  EXPECT_NEAR(limit.limit_dps, 69.75, 5.0 * 0.05 / std::sqrt(2400.0));
  EXPECT_NEAR(limit.below_dps, 70.25, 5.0 * 0.05 / std::sqrt(2400.0));
}

/// Of the element, and noise comes after: steps and bursts stood in for it.
TEST(NearForms, ALimitOnOneSideIsOneEffect) {
  Scenario s = moving();
  s.effects = {effects::Saturation{.limit_dps = 200.0, .of_element = 1.0, .below_dps = 76.0}};
  const Found found(recorded(s, 70, true));
  EXPECT_EQ(found.names(), std::set<std::string>{"saturation"});
  const auto& limit = found.first<effects::Saturation>();
  EXPECT_GT(limit.limit_dps, 80.0);
  // Of 14,400 samples of the train part a tenth are at the limit: 5 standard errors.
  EXPECT_NEAR(limit.below_dps, 76.0, 5.0 * 0.05 / std::sqrt(1440.0));
}

/// Of the element, before its filter or behind it: in the other order a shift, a knee and telegraph
/// noise stood in for what the filter makes of a limit.
TEST(NearForms, ALimitStandsOnItsOwnSideOfAFilter) {
  Scenario s = moving(0.5 * ten_minutes_s);
  for (const double of_element : {1.0, 2.0}) {
    s.effects = {
        effects::Saturation{.limit_dps = 64.75, .of_element = of_element, .below_dps = 65.25},
        effects::SensorBandwidth{.cutoff_hz = 1.0}};
    const Found found(recorded(s, 31, true));
    ASSERT_EQ(found.names(), (std::set<std::string>{"saturation", "sensor_bandwidth"}));
    for (const auto& effect : found.set.scenario.effects)
      if (const auto* limit = effect.as<effects::Saturation>()) {
        EXPECT_EQ(limit->of_element, of_element);
        EXPECT_NEAR(limit->below_dps - limit->limit_dps, 0.5, 0.05) << limit->knee;
      }
  }
}

/// Moved behind the filter when all had been found, it missed the recording at p = 6e-76; begun as
/// if it were behind it, it took a filter of half a hertz six other effects to make up for that.
TEST(NearForms, ADeadZoneStandsOnItsOwnSideOfAFilter) {
  Scenario s = moving(0.5 * ten_minutes_s);
  for (const auto& [of_element, cutoff_hz] :
       {std::pair{0.0, 1.0}, std::pair{1.0, 1.0}, std::pair{1.0, 0.5}}) {
    s.effects = {effects::SensorBandwidth{.cutoff_hz = cutoff_hz},
                 effects::DeadZone{.half_width_dps = 2.0, .of_element = of_element}};
    const Found found(recorded(s, 32, true));
    ASSERT_EQ(found.names(), (std::set<std::string>{"dead_zone", "sensor_bandwidth"}));
    for (const auto& effect : found.set.scenario.effects)
      if (const auto* zone = effect.as<effects::DeadZone>()) {
        EXPECT_EQ(zone->of_element, of_element);
        // The motion passes by 0.8 dps from one sample to the next.
        EXPECT_NEAR(zone->half_width_dps, 2.0, 0.8);
      }
  }
}

/// What is clipped before the noise is about two values, as on a grid that is coarser than it.
TEST(NearForms, ALimitBeforeTheNoiseIsNoGrid) {
  Scenario s = moving(0.5 * ten_minutes_s);
  s.motion = motion::Sinusoidal{80.0, 0.3};
  for (const double cutoff_hz : {1.0, 3.0}) {
    s.effects = {effects::SensorBandwidth{.cutoff_hz = cutoff_hz},
                 effects::Saturation{.limit_dps = 50.0, .of_element = 1.0}};
    EXPECT_EQ(Found(recorded(s, 32, true)).names(),
              (std::set<std::string>{"saturation", "sensor_bandwidth"}));
  }
}

/// What lags by a fiftieth of a sample is late by as much: no recording tells them apart, and both
/// are in the answer.
TEST(NearForms, ALagFarBelowASampleMayBeAShift) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::SensorBandwidth{.cutoff_hz = 160.0, .continuous = 1.0}};
  const Series series = recorded(s, 64, true);
  const Found found(series);
  ASSERT_EQ(found.set.members.size(), 1);
  EXPECT_LT(found.set.members.front().log_odds, 2.0);
  std::set<std::string> either = {found.set.members.front().effect};
  for (const auto& rival : found.set.rivals) either.insert(rival.effect);
  EXPECT_TRUE(either.contains("sensor_bandwidth"));
  EXPECT_TRUE(either.contains("time_offset"));
}

/// A filter whose poles ring is no vibration, and none that nearly do needs an average besides.
TEST(NearForms, AFilterOfAnyDampingIsOneEffect) {
  for (const double damping_ratio : {0.35, 0.9}) {
    Scenario s = still(ten_minutes_s);
    s.random_error.measurement_noise_std_dps = 0.1;
    s.effects = {effects::NoiseBandwidth{
        .cutoff_hz = 3.0, .poles = 2.0, .after_dps = 0.012, .damping_ratio = damping_ratio}};
    const Series series = recorded(s, 65, false);
    const Found found(series);
    EXPECT_EQ(found.names(), std::set<std::string>{"noise_bandwidth"});
    const auto& effect = found.first<effects::NoiseBandwidth>();
    EXPECT_NEAR(effect.cutoff_hz, 3.0, 0.15);
    EXPECT_NEAR(effect.damping_ratio, damping_ratio, 0.1 * damping_ratio);
  }
}

/// As a driver that casts to an integer does: outliers, repeats and a telegraph stood in for the
/// zeros that are twice as many.
TEST(NearForms, ValuesThatAreCutOffTowardsZeroAreOneEffect) {
  for (const double lsb_dps : {0.02, 0.05}) {
    Scenario s = still();
    s.temperature = temperature::QuietRoom{.start_C = 38.0, .end_C = 38.5};
    s.thermal_drift.c_dps = 0.085;
    Series series = recorded(s, 66, false);
    for (double& z : series.gyro_dps) z = lsb_dps * std::trunc(z / lsb_dps);
    const Found found(series);
    EXPECT_EQ(found.names(), std::set<std::string>{"quantization"});
    EXPECT_EQ(found.first<effects::Quantization>().towards_zero, 1.0);
    // The noise under the grid, to 5 standard errors of some 20,000 samples.
    EXPECT_NEAR(found.set.scenario.random_error.measurement_noise_std_dps, 0.05,
                5.0 * 0.05 / std::sqrt(2.0 * 20000.0) + 0.002);
  }
}

/// Under a motion that hardly stays near zero: a zone that takes half a step off each value.
TEST(NearForms, ValuesThatAreCutOffUnderAMotionAreOneEffect) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleFactor{0.01},
               effects::Quantization{.lsb_dps = 0.06, .towards_zero = 1.0}};
  const Found found(recorded(s, 71, true));
  EXPECT_EQ(found.names(), (std::set<std::string>{"quantization", "scale_factor"}));
  for (const auto& effect : found.set.scenario.effects) {
    const auto* grid = effect.as<effects::Quantization>();
    EXPECT_TRUE(grid == nullptr || grid->towards_zero == 1.0);
  }
}

/// Three neighbours, twice in a row, and the converter's noise: taps 1, 2, 3, 2, 1, which leave
/// nothing at a third of the rate. A filter of any damping, a line and an average of faster samples
/// stood in for them.
TEST(NearForms, AnAverageOfTheOutputsOwnSamplesIsOne) {
  Scenario s = still(ten_minutes_s);
  s.effects = {
      effects::NoiseAveraging{.length = 3.0, .stages = 2.0, .of_samples = 1.0, .after_dps = 0.003}};
  const Found found(recorded(s, 71, false));
  ASSERT_EQ(found.names(), std::set<std::string>{"noise_averaging"});
  const auto& average = found.first<effects::NoiseAveraging>();
  EXPECT_EQ(average.stages, 2.0);
  EXPECT_EQ(average.of_samples, 1.0);
  EXPECT_NEAR(average.length, 3.0, 0.05);
}

/// As where a log is put on another clock. The largest innovations had been outliers.
TEST(NearForms, LinesBetweenTheSamplesOfAnotherClockAreAnAverage) {
  Scenario s = still(ten_minutes_s);
  for (const double slip : {0.0421, -0.0421}) {
    s.effects = {effects::NoiseAveraging{.slip = slip}};
    const Found found(recorded(s, 84, false));
    ASSERT_EQ(found.names(), std::set<std::string>{"noise_averaging"}) << slip;
    EXPECT_NEAR(found.first<effects::NoiseAveraging>().slip, slip, 1e-4);
    for (const auto& left : found.set.unexplained) EXPECT_GT(left.p_value, 1e-4) << left.what;
  }
}

/// A sine that is on for a quarter of the time, each time for half a minute, softly and from
/// another phase: in its spectrum it is as narrow as one whose phase goes astray, and was called a
/// wandering line.
TEST(NearForms, ASineThatComesAndGoesIsBursts) {
  Series series = recorded(still(), 72, false);
  for (std::size_t i = 0; i < series.size(); ++i) {
    constexpr double every_s[] = {0.0, 131.0, 227.0, 371.0, 452.0, 611.0, 733.0, 904.0, 1065.0};
    for (const double begins_s : every_s) {
      const double into = series.t_s[i] - begins_s;
      const double gate = 0.5 * (std::tanh(into - 20.0) - std::tanh(into - 50.0));
      series.gyro_dps[i] +=
          0.06 * gate * std::sin(2.0 * std::numbers::pi * 4.7 * into + begins_s * begins_s);
    }
  }
  EXPECT_EQ(Found(series).names(), std::set<std::string>{"vibration_bursts"});
}

/// A compass that is five times slower than the gyro, disturbed by 2 degrees for 20 s at a time.
TEST(NearForms, BurstsOfASlowCompassAreFound) {
  Series series = recorded(still(), 73, false);
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (i % 5 != 0) series.heading_deg[i] = no_value;
    if (std::fmod(series.t_s[i] + 60.0, 200.0) < 20.0) series.heading_deg[i] += 2.0;
  }
  EXPECT_EQ(Found(series).names(), std::set<std::string>{"magnetic_bursts"});
}

/// Means of a fifth of a second have no resonances, and hid it: three sines stood in for it, and a
/// filter of the noise for what they left.
TEST(NearForms, ALineThatIsSlowInAShortRecordingIsALine) {
  Scenario s = still();
  s.sampling = {700.0, 25.0};
  s.effects = {effects::Vibration{.std_dps = 0.04, .centre_hz = 1.85, .bandwidth_hz = 0.16}};
  EXPECT_EQ(Found(recorded(s, 74, false)).names(), std::set<std::string>{"vibration"});
}

/// Three times a minute at one phase: a comb of sines, of which a band of a hundredth of a hertz
/// leaves others.
TEST(NearForms, ALineThatComesThreeTimesIsOneEffect) {
  Series series = recorded(still(), 75, false);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const bool is_on = std::fmod(series.t_s[i] + 330.0, 390.0) < 60.0;
    if (is_on) series.gyro_dps[i] += 0.15 * std::sin(2.0 * std::numbers::pi * 5.16 * series.t_s[i]);
  }
  EXPECT_EQ(Found(series).names(), std::set<std::string>{"vibration_bursts"});
}

/// One band that is half as wide as its centre is high stood in for both, with a telegraph or
/// without.
TEST(NearForms, AnAnglesErrorsBesideFlickerAreNoBand) {
  Scenario s = still();
  s.sampling = {1760.0, 30.0};
  s.random_error.measurement_noise_std_dps = 0.041;
  for (const double coefficient_deg : {8e-4, 1e-3}) {
    s.effects = {effects::AngleQuantization{coefficient_deg},
                 effects::BiasInstability{.coefficient_dps = 0.024}};
    EXPECT_EQ(Found(recorded(s, 1, false)).names(),
              (std::set<std::string>{"angle_quantization", "bias_instability"}))
        << coefficient_deg;
  }
}

/// A recorder's own noise, or a calibration after the converter, leaves values about a grid, on
/// which none is. The standard errors are those of a mean deviation of 18,000 values.
TEST(NearForms, AGridWithNoiseOnItIsAGrid) {
  for (const double lsb_dps : {0.02, 0.12}) {
    Scenario s = still();
    const double after_dps = 0.06 * lsb_dps;
    s.effects = {effects::Quantization{
        .lsb_dps = lsb_dps, .offset_dps = 0.3 * lsb_dps, .after_dps = after_dps}};
    const Found found(recorded(s, 79, false));
    ASSERT_EQ(found.names(), std::set<std::string>{"quantization"}) << lsb_dps;
    const auto& grid = found.first<effects::Quantization>();
    EXPECT_NEAR(grid.lsb_dps, lsb_dps, 1e-3 * lsb_dps);
    EXPECT_NEAR(grid.offset_dps, 0.3 * lsb_dps, 0.01 * lsb_dps);
    EXPECT_NEAR(grid.after_dps, after_dps, 5.0 * after_dps / std::sqrt(2.0 * 18000.0));
  }
}

/// Three degrees up and down are two widths.
TEST(NearForms, HysteresisOfARoomIsFound) {
  Scenario s = still();
  s.temperature = temperature::Cycle{24.0, 27.0, 800.0};
  s.effects = {effects::ThermalHysteresis{.amplitude_dps = 0.08, .width_C = 0.8}};
  EXPECT_EQ(Found(recorded(s, 77, false)).names(), std::set<std::string>{"thermal_hysteresis"});
}

/// Whose end had been a dead zone and a limit.
TEST(NearForms, AScaleThatIsNotLinearIsOne) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleFactor{.error = 0.004, .cubic_per_dps2 = 2e-7}};
  const Found found(recorded(s, 81, true));
  ASSERT_EQ(found.names(), std::set<std::string>{"scale_factor"});
  EXPECT_NEAR(found.first<effects::ScaleFactor>().cubic_per_dps2, 2e-7, 2e-8);
}

/// A scale, a limit and a line stood in for the other side. The edges are between samples 0.4 dps
/// apart.
TEST(NearForms, ADeadZoneThatEndsElsewhereBelowZeroIsOne) {
  for (const double lost : {0.0, 1.0}) {
    Scenario s = moving(ten_minutes_s);
    s.effects = {effects::DeadZone{.half_width_dps = 1.4, .lost_beyond = lost, .below_dps = 0.7}};
    const Found found(recorded(s, 80, true));
    ASSERT_EQ(found.names(), std::set<std::string>{"dead_zone"}) << lost;
    const auto& zone = found.first<effects::DeadZone>();
    EXPECT_NEAR(zone.half_width_dps, 1.4, 0.4);
    EXPECT_NEAR(zone.below_dps, 0.7, 0.4);
    EXPECT_NEAR(zone.lost_beyond * zone.half_width_dps, lost * 1.4, 0.05);
    EXPECT_NEAR(zone.lost_beyond * zone.below_dps, lost * 0.7, 0.05);
  }
}

/// Recorders differ by half samples, not by a fifteenth of one.
TEST(NearForms, AFractionOfASampleIsALag) {
  for (const double recorder : {-0.5, 0.0, 0.5}) {
    Series series = recorded(moving(ten_minutes_s), 78, true);
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double late_s = (recorder + 1.0 / 15.0) / 20.0;
      series.heading_deg[i] =
          std::remainder(series.heading_deg[i] - late_s * series.rate_ref_dps[i], 360.0);
    }
    EXPECT_EQ(Found(series).names(), std::set<std::string>{"compass_lag"}) << recorder;
  }
}

/// Simulators add up so many Gauss-Markov processes, from a time of their own on: a fourth of the
/// coefficient, a telegraph and steps stood in for what is not faster.
TEST(NearForms, FlickerThatEndsAtSomeFrequencyIsOneEffect) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effects::BiasInstability{.coefficient_dps = 0.05, .shortest_s = 1.2}};
  const Series series = recorded(s, 68, false);
  const Found found(series);
  ASSERT_EQ(found.names(), std::set<std::string>{"bias_instability"});
  const auto& effect = found.first<effects::BiasInstability>();
  EXPECT_NEAR(effect.coefficient_dps, 0.05, 0.01);
  EXPECT_NEAR(std::log(effect.shortest_s / 1.2), 0.0, 0.4);
}

}  // namespace
}  // namespace gyrostat::gap::near_forms_test
