#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/list.hpp>

namespace gyrostat::effects_test {
namespace {

using effects::Outliers;
using effects::ThermalCurvature;
using effects::ThermalHysteresis;

/// What the effect adds to the drift of a sensor that goes through these temperatures.
template <class Effect>
std::vector<double> drift(const Effect& effect, const std::vector<double>& temperature_C) {
  Series series;
  series.temperature_C = temperature_C;
  series.t_s.resize(temperature_C.size());
  series.thermal_bias_dps.resize(temperature_C.size());
  effect.apply(series, {1, 0});
  return series.thermal_bias_dps;
}

/// From one temperature to another and on, 0.25 °C at a time.
std::vector<double> moves(const std::vector<double>& turning_points) {
  std::vector<double> T = {turning_points.front()};
  for (const double to : turning_points)
    while (T.back() != to) T.push_back(T.back() + (to > T.back() ? 0.25 : -0.25));
  return T;
}

TEST(ThermalCurvature, IsTheParabolaAboutItsReference) {
  const auto bias = drift(ThermalCurvature{.curvature_dps_per_C2 = 2e-4, .reference_C = 40.0},
                          {40.0, 30.0, 50.0, 41.0});
  EXPECT_EQ(bias[0], 0.0);
  EXPECT_DOUBLE_EQ(bias[1], 0.02);
  EXPECT_DOUBLE_EQ(bias[2], 0.02);
  EXPECT_DOUBLE_EQ(bias[3], 2e-4);
}

TEST(ThermalCurvature, AddsACubicAboutTheSameReference) {
  const auto bias = drift(
      ThermalCurvature{.curvature_dps_per_C2 = 2e-4, .reference_C = 40.0, .cubic_dps_per_C3 = 1e-5},
      {40.0, 30.0, 50.0});
  EXPECT_EQ(bias[0], 0.0);
  EXPECT_DOUBLE_EQ(bias[1], 0.01);
  EXPECT_DOUBLE_EQ(bias[2], 0.03);
}

TEST(ThermalCurvature, HasAKink) {
  const auto bias =
      drift(ThermalCurvature{.curvature_dps_per_C2 = 0.0, .kink_dps_per_C = -0.02, .kink_C = 40.0},
            {10.0, 40.0, 50.0});
  EXPECT_EQ(bias[0], 0.0);
  EXPECT_EQ(bias[1], 0.0);
  EXPECT_DOUBLE_EQ(bias[2], -0.2);
}

TEST(EmpiricalMean, GoesStraightFromKnotToKnotAndStaysBeyond) {
  const auto bias = drift(effects::EmpiricalMeanOverTemperature{.from = 20.0,
                                                                .span = 40.0,
                                                                .mean_1_dps = 0.1,
                                                                .mean_2_dps = -0.1,
                                                                .mean_5_dps = 0.0,
                                                                .mean_9_dps = 0.3},
                          {20.0, 22.5, 25.0, 30.0, 57.5, 60.0, 70.0, 10.0, no_value});
  const std::vector<double> expected{0.1, 0.0, -0.1, 0.0, 0.15, 0.3, 0.3, 0.1, 0.0};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(bias[k], expected[k], 1e-15) << k;
}

TEST(ThermalHysteresis, ALongMoveOneWayEndsOnThePlusOrMinusBranch) {
  const ThermalHysteresis hysteresis{.amplitude_dps = 0.01, .width_C = 3.0};
  EXPECT_DOUBLE_EQ(drift(hysteresis, moves({20.0, 40.0})).back(), 0.01);
  EXPECT_DOUBLE_EQ(drift(hysteresis, moves({40.0, 20.0})).back(), -0.01);
  EXPECT_DOUBLE_EQ(drift(hysteresis, moves({20.0, 40.0, 20.0})).back(), -0.01);
  EXPECT_DOUBLE_EQ(drift(hysteresis, moves({20.0, 40.0, 20.0, 27.0})).back(), 0.01);
}

TEST(ThermalHysteresis, LeadsFromBranchToBranchOverTwiceItsWidth) {
  const ThermalHysteresis hysteresis{.amplitude_dps = 0.01, .width_C = 3.0};
  EXPECT_NEAR(drift(hysteresis, moves({20.0, 40.0, 37.0})).back(), 0.0, 1e-15);
  EXPECT_NEAR(drift(hysteresis, moves({20.0, 40.0, 34.25})).back(), -0.01 * 11.0 / 12.0, 1e-15);
  EXPECT_DOUBLE_EQ(drift(hysteresis, moves({20.0, 40.0, 34.0})).back(), -0.01);
}

/// A triangle of 300 samples up, then down, rounded to five of its steps, to and fro by less than
/// the width in between.
TEST(ThermalHysteresis, ThatIsSuddenIsTheSignOfWhatTheTemperatureDoes) {
  std::vector<double> T;
  for (int i = 0; i < 1200; ++i) {
    const int turn = i % 600;
    const double exact = 0.01 * (turn < 300 ? turn : 600 - turn) + (i % 97 < 10 ? 0.1 : 0.0);
    T.push_back(0.05 * std::round(exact / 0.05));
  }
  const auto B = drift(ThermalHysteresis{.amplitude_dps = 0.02, .width_C = 0.5, .sudden = 1.0}, T);
  for (int i = 0; i < 1200; ++i) {
    constexpr int near_a_turn = 12;
    if ((i + near_a_turn) % 300 < 2 * near_a_turn) continue;
    EXPECT_EQ(B[i], i / 300 % 2 == 0 ? 0.02 : -0.02) << i;
  }
  const std::vector<double> still(50, 25.0);
  EXPECT_EQ(drift(ThermalHysteresis{.amplitude_dps = 0.02, .sudden = 1.0}, still)[20], 0.0);
}

TEST(ThermalHysteresis, AddsPlaysOfNarrowerWidths) {
  const std::vector<double> T = moves({20.0, 40.0, 33.0, 38.0, 25.0});
  ThermalHysteresis all{.amplitude_dps = 0.01, .width_C = 4.0, .first_branch = 1.0};
  const auto whole = drift(all, T);
  const auto three =
      drift(ThermalHysteresis{.amplitude_dps = 0.02, .width_C = 3.0, .first_branch = 1.0}, T);
  const auto half =
      drift(ThermalHysteresis{.amplitude_dps = -0.03, .width_C = 2.0, .first_branch = 1.0}, T);
  const auto quarter =
      drift(ThermalHysteresis{.amplitude_dps = 0.04, .width_C = 1.0, .first_branch = 1.0}, T);
  all.of_three_quarters_dps = 0.02;
  all.of_half_dps = -0.03;
  all.of_quarter_dps = 0.04;
  const auto sum = drift(all, T);
  for (std::size_t k = 0; k < T.size(); ++k)
    EXPECT_NEAR(sum[k], whole[k] + three[k] + half[k] + quarter[k], 1e-15) << k;
}

TEST(ThermalHysteresis, ClosesItsLoop) {
  const ThermalHysteresis hysteresis{.amplitude_dps = 0.01, .width_C = 3.0};
  for (const double low : {25.0, 36.0, 39.0}) {
    const auto bias = drift(hysteresis, moves({20.0, 40.0, low, 40.0, low, 40.0}));
    const auto loop = static_cast<std::size_t>(8.0 * (40.0 - low));
    for (std::size_t k = bias.size() - loop; k < bias.size(); ++k)
      EXPECT_NEAR(bias[k], bias[k - loop], 1e-15) << "loop down to " << low;
  }
}

TEST(ThermalHysteresis, TheLoopOfALongCycleEnclosesItsTheoreticalArea) {
  const ThermalHysteresis hysteresis{.amplitude_dps = 0.01, .width_C = 3.0};
  const auto T = moves({20.0, 50.0, 20.0, 50.0});
  const auto bias = drift(hysteresis, T);
  double area = 0.0;  // over the last closed cycle, from 50 °C to 50 °C
  for (std::size_t k = T.size() - 240; k < T.size(); ++k)
    area += 0.5 * (bias[k] + bias[k - 1]) * (T[k] - T[k - 1]);
  // A parallelogram of height 2 amplitude and width 30 - 2 width, by the trapezoid rule exactly.
  EXPECT_NEAR(std::abs(area), 2.0 * 0.01 * (30.0 - 6.0), 1e-12);
}

TEST(ThermalHysteresis, DependsOnTheOrderOfTemperaturesAndNotOnTime) {
  const ThermalHysteresis hysteresis{.amplitude_dps = 0.01, .width_C = 3.0};
  const auto once = moves({20.0, 40.0, 30.0});
  std::vector<double> twice;
  for (const double T : once) twice.insert(twice.end(), {T, T});
  const auto fast = drift(hysteresis, once), slow = drift(hysteresis, twice);
  for (std::size_t k = 0; k < fast.size(); ++k) EXPECT_EQ(fast[k], slow[2 * k]);
}

/// 1 - exp(-rise / width), and from there to the other branch: a twentieth of the width behind, and
/// on the way back twice that. What goes to and fro by less is not seen.
TEST(ThermalHysteresis, MayApproachItsBranchGradually) {
  const ThermalHysteresis gradual{.amplitude_dps = 0.01, .width_C = 3.0, .gradual = 1.0};
  const double up = 1.0 - std::exp(-(20.0 - 0.15) / 3.0);
  EXPECT_NEAR(drift(gradual, moves({20.0, 40.0})).back(), 0.01 * up, 1e-15);
  EXPECT_NEAR(drift(gradual, moves({20.0, 40.0, 36.75})).back(),
              0.01 * (-1.0 + (up + 1.0) * std::exp(-(3.25 - 0.3) / 3.0)), 1e-15);
  auto noisy = moves({20.0, 40.0});
  noisy.insert(noisy.end(), {39.8, 40.0, 39.8});
  EXPECT_NEAR(drift(gradual, noisy).back(), 0.01 * up, 1e-15);
  const auto still = drift(gradual, {20.0, 25.0, 25.0, 25.0});
  EXPECT_EQ(still[1], still[3]);
}

TEST(ThermalHysteresis, MayBeginOnEitherBranch) {
  for (const double gradual : {0.0, 1.0}) {
    const ThermalHysteresis above{0.01, 3.0, gradual, 1.0}, below{0.01, 3.0, gradual, -1.0};
    EXPECT_DOUBLE_EQ(drift(above, moves({20.0, 40.0})).front(), 0.01);
    EXPECT_DOUBLE_EQ(drift(above, moves({20.0, 40.0})).back(), 0.01);
    EXPECT_DOUBLE_EQ(drift(below, moves({20.0, 40.0})).front(), -0.01);
    EXPECT_DOUBLE_EQ(drift(below, moves({40.0, 20.0})).back(), -0.01);
  }
}

TEST(ThermalEffects, OfZeroStrengthAddExactlyNothing) {
  const auto T = moves({20.0, 40.0, 20.0});
  for (const double v :
       drift(ThermalCurvature{.curvature_dps_per_C2 = 0.0, .reference_C = 30.0}, T))
    EXPECT_EQ(v, 0.0);
  for (const double v : drift(ThermalHysteresis{.amplitude_dps = 0.0, .width_C = 3.0}, T))
    EXPECT_EQ(v, 0.0);
}

std::vector<double> outliers(const Outliers& effect, std::size_t samples, std::uint32_t trial = 0) {
  Series series;
  series.t_s.resize(samples);
  series.gyro_dps.resize(samples);
  effect.apply(series, {1, trial});
  return series.gyro_dps;
}

// The hits are binomial and their mean square has relative standard error sqrt(2 / hits); at 5
// standard errors each fails falsely at 6e-7.
TEST(Outliers, HitTheirShareOfSamplesWithTheirStandardDeviation) {
  constexpr std::size_t n = 500000;
  const Outliers effect{.probability = 0.01, .std_dps = 3.0};
  double hits = 0.0, square = 0.0;
  for (const double v : outliers(effect, n)) {
    hits += v != 0.0;
    square += v * v;
  }
  EXPECT_NEAR(hits, 5000.0, 5.0 * std::sqrt(n * 0.01 * 0.99));
  EXPECT_NEAR(square / hits, 9.0, 5.0 * 9.0 * std::sqrt(2.0 / hits));
}

TEST(Outliers, OfZeroProbabilityOrZeroStandardDeviationAddExactlyNothing) {
  for (const double v : outliers({.probability = 0.0, .std_dps = 3.0}, 1000)) EXPECT_EQ(v, 0.0);
  for (const double v : outliers({.probability = 1.0, .std_dps = 0.0}, 1000)) EXPECT_EQ(v, 0.0);
}

TEST(Outliers, OfProbabilityOneAreWhiteNoiseOnEverySample) {
  for (const double v : outliers({.probability = 1.0, .std_dps = 3.0}, 1000)) EXPECT_NE(v, 0.0);
}

TEST(Outliers, AreTheSameHitsAtAnyStrengthAndMoreOfThemAtAHigherProbability) {
  const auto weak = outliers({.probability = 0.01, .std_dps = 1.0}, 10000);
  const auto strong = outliers({.probability = 0.01, .std_dps = 10.0}, 10000);
  const auto more = outliers({.probability = 0.1, .std_dps = 1.0}, 10000);
  for (std::size_t k = 0; k < weak.size(); ++k) {
    EXPECT_DOUBLE_EQ(strong[k], 10.0 * weak[k]);
    EXPECT_EQ(weak[k] == 0.0 ? 0.0 : more[k], weak[k]);
  }
}

}  // namespace
}  // namespace gyrostat::effects_test
