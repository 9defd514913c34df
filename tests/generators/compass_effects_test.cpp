#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::compass_effects_test {
namespace {

/// The heading error that the effect adds to these headings, 0.1 s apart.
template <class Effect>
std::vector<double> error(const Effect& effect, const std::vector<double>& heading_deg,
                          std::uint32_t trial = 0) {
  auto series = silent(even_times(heading_deg.size(), 10.0));
  series.heading_deg = heading_deg;
  effect.apply(series, {1, trial});
  for (std::size_t i = 0; i < heading_deg.size(); ++i)
    series.heading_deg[i] = wrap_degrees(series.heading_deg[i] - heading_deg[i]);
  return series.heading_deg;
}

std::vector<double> full_turn() {
  std::vector<double> heading;
  for (int i = -180; i < 180; ++i) heading.push_back(i);
  return heading;
}

/// Complex amplitude of A sin(k h + phase), in degrees of phase: A exp(i phase).
std::complex<double> harmonic(const std::vector<double>& errors, int k) {
  std::complex<double> sum;
  const auto heading = full_turn();
  for (std::size_t i = 0; i < heading.size(); ++i)
    sum += errors[i] * std::polar(1.0, -k * heading[i] * std::numbers::pi / 180.0);
  return sum * std::complex<double>(0.0, 2.0 / static_cast<double>(heading.size()));
}

void expect_only_harmonic(const std::vector<double>& errors, int only) {
  for (int k = 1; k <= 4; ++k) {
    const auto expected = k == only ? std::polar(3.0, std::numbers::pi / 6.0) : 0.0;
    EXPECT_NEAR(std::abs(harmonic(errors, k) - expected), 0.0, 1e-9) << "harmonic " << k;
  }
}

TEST(HardIron, IsTheFirstHarmonicOfTheHeadingAndNoOther) {
  expect_only_harmonic(
      error(effects::HardIron{.amplitude_deg = 3.0, .phase_deg = 30.0}, full_turn()), 1);
}

TEST(SoftIron, IsTheSecondHarmonicOfTheHeadingAndNoOther) {
  expect_only_harmonic(
      error(effects::SoftIron{.amplitude_deg = 3.0, .phase_deg = 30.0}, full_turn()), 2);
}

/// A field of the same direction in the vehicle, or one that bends with it, adds up to what is
/// measured; its largest error is the amplitude.
TEST(Iron, InExactFormIsTheDirectionOfTheSumOfFields) {
  constexpr double rad = std::numbers::pi / 180.0, amplitude_deg = 8.0, phase_deg = 30.0;
  const auto heading = full_turn();
  for (const double periods : {1.0, 2.0}) {
    const auto errors = periods == 1.0
                            ? error(effects::HardIron{amplitude_deg, phase_deg, 1.0}, heading)
                            : error(effects::SoftIron{amplitude_deg, phase_deg, 1.0}, heading);
    double largest = 0.0;
    for (std::size_t i = 0; i < heading.size(); ++i) {
      const auto field = std::polar(1.0, -heading[i] * rad);
      const auto bent = periods == 1.0 ? std::complex(1.0) : std::conj(field);
      const auto sum = field - std::polar(std::sin(amplitude_deg * rad), phase_deg * rad) * bent;
      EXPECT_NEAR(std::remainder(-std::arg(sum) / rad - heading[i] - errors[i], 360.0), 0.0, 1e-9);
      largest = std::max(largest, std::abs(errors[i]));
    }
    EXPECT_NEAR(largest, amplitude_deg, 0.01 * amplitude_deg);
  }
}

/// A slow turn is late by as much whichever is filtered.
TEST(CompassLag, OfTheFieldIsThatOfItsDirectionWhereTheTurnIsSlow) {
  std::vector<double> turning;
  for (int k = 0; k < 400; ++k) turning.push_back(0.05 * k);
  const auto direction = error(effects::CompassLag{.time_constant_s = 1.0}, turning);
  const auto field = error(effects::CompassLag{.time_constant_s = 1.0, .of_field = 1.0}, turning);
  EXPECT_NEAR(field.back(), direction.back(), 1e-3);
  EXPECT_NEAR(direction.back(), -0.5, 1e-3);  // of half a degree a second
}

/// A step is a rise over one interval d: behind it (1 - e^{-d/tau}) tau / d of the step at its end.
TEST(CompassLag, DecaysAfterAStepWithItsTimeConstant) {
  std::vector<double> step(100, 60.0);
  step[0] = 0.0;
  const auto behind = error(effects::CompassLag{.time_constant_s = 2.0}, step);
  EXPECT_EQ(behind[0], 0.0);
  EXPECT_NEAR(behind[1], -60.0 * (1.0 - std::exp(-0.05)) * 20.0, 1e-11);
  for (std::size_t k = 1; k < step.size(); ++k)
    EXPECT_NEAR(behind[k], behind[1] * std::exp(-0.05 * static_cast<double>(k - 1)), 1e-11);
}

TEST(CompassLag, TrailsAnEvenTurnByRateTimesTimeConstantThroughTheWrap) {
  std::vector<double> turning;
  for (int i = 0; i < 3000; ++i) turning.push_back(wrap_degrees(4.0 * i));  // 40 dps
  EXPECT_NEAR(error(effects::CompassLag{.time_constant_s = 0.5}, turning).back(), -20.0, 1e-9);
}

TEST(CompassLag, OfTwoPolesIsTwoLagsOfHalfItsTimeEach) {
  std::vector<double> step(100, 60.0);
  step[0] = 0.0;
  auto twice = silent(even_times(step.size(), 10.0));
  twice.heading_deg = step;
  const effects::CompassLag half{.time_constant_s = 1.0};
  half.apply(twice, {1, 0});
  half.apply(twice, {1, 0});
  const auto behind = error(effects::CompassLag{.time_constant_s = 2.0, .poles = 2.0}, step);
  for (std::size_t k = 0; k < step.size(); ++k)
    EXPECT_NEAR(behind[k], twice.heading_deg[k] - step[k], 1e-11);
}

/// An even turn is behind by rate times delay once it has begun, whatever part of a sample that is.
TEST(CompassLag, IsBehindByItsDelay) {
  std::vector<double> turning;
  for (int i = 0; i < 300; ++i) turning.push_back(wrap_degrees(170.0 + 4.0 * i));  // 40 dps
  for (const double delay_s : {0.05, 0.1, 0.73}) {
    const auto behind =
        error(effects::CompassLag{.time_constant_s = 0.0, .delay_s = delay_s}, turning);
    for (std::size_t i = 0; i < behind.size(); ++i)
      EXPECT_NEAR(wrap_degrees(behind[i]), -40.0 * std::min(delay_s, 0.1 * static_cast<double>(i)),
                  1e-9)
          << delay_s << " s, " << i;
  }
}

/// What iron adds is there at once, where turns alone trail.
TEST(CompassLag, OfTurnsAloneLeavesIronAsItIs) {
  auto series = silent(even_times(2000, 10.0));
  series.rate_ref_dps.assign(series.size(), 40.0);
  for (std::size_t i = 0; i < series.size(); ++i)
    series.heading_deg[i] = 4.0 * static_cast<double>(i);
  const auto turned = series.heading_deg;
  effects::HardIron{.amplitude_deg = 5.0, .phase_deg = 20.0}.apply(series, {1, 0});
  const auto with_iron = series.heading_deg;
  effects::CompassLag{.time_constant_s = 0.5, .turns_alone = 1.0}.apply(series, {1, 0});
  for (std::size_t i = 200; i < series.size(); ++i)
    EXPECT_NEAR(series.heading_deg[i], with_iron[i] - 20.0, 1e-9) << i;
}

TEST(CompassLag, TakesTheShorterWayRound) {
  std::vector<double> step(50, -170.0);
  step[0] = 170.0;
  for (const double behind : error(effects::CompassLag{.time_constant_s = 1.0}, step)) {
    EXPECT_LE(behind, 0.0);
    EXPECT_GE(behind, -20.0);
  }
}

TEST(CompassLag, TrailsTheHeadingAndNotItsNoise) {
  Scenario scenario;
  Series still, lagging;
  synthesise(scenario, {1, 0}, still);
  scenario.effects = {effects::CompassLag{.time_constant_s = 10.0}};
  synthesise(scenario, {1, 0}, lagging);
  EXPECT_EQ(still.heading_deg, lagging.heading_deg);
}

TEST(CompassEffects, LeaveTheHeadingWrapped) {
  Scenario scenario;
  scenario.motion = motion::RateTable{.rate_dps = 60.0};
  scenario.effects = {effects::HardIron{.amplitude_deg = 40.0},
                      effects::SoftIron{.amplitude_deg = 40.0},
                      effects::CompassLag{.time_constant_s = 2.0},
                      effects::MagneticBursts{.bursts_per_hour = 500.0, .std_deg = 300.0}};
  Series series;
  synthesise(scenario, {1, 0}, series);
  for (const double heading : series.heading_deg) {
    EXPECT_GE(heading, -180.0);
    EXPECT_LT(heading, 180.0);
  }
}

constexpr std::uint32_t trials = 4000;

// From quiet at time 0, in a burst with probability a / (a + b) (1 - exp(-(a + b) t)), a and b the
// rates of beginning and ending; the mean square is that times std^2, with E x^4 = 3 std^4. At 5
// standard errors: 6e-7 each.
TEST(MagneticBursts, StandForTheirShareOfTheTimeWithTheirStandardDeviation) {
  const effects::MagneticBursts bursts{
      .bursts_per_hour = 900.0, .mean_duration_s = 2.0, .std_deg = 4.0};
  const std::vector<double> north(301, 0.0);
  std::array<double, 3> share{}, square{};
  constexpr std::array<std::size_t, 3> at = {5, 20, 300};
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto e = error(bursts, north, trial);
    for (std::size_t k = 0; k < at.size(); ++k) {
      share[k] += (e[at[k]] != 0.0) / double{trials};
      square[k] += e[at[k]] * e[at[k]] / trials;
    }
  }
  constexpr double a = 0.25, b = 0.5;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double t = 0.1 * static_cast<double>(at[k]);
    const double p = a / (a + b) * (1.0 - std::exp(-(a + b) * t));
    EXPECT_NEAR(share[k], p, 5.0 * std::sqrt(p * (1.0 - p) / trials)) << t;
    EXPECT_NEAR(square[k], 16.0 * p, 5.0 * 16.0 * std::sqrt((3.0 * p - p * p) / trials)) << t;
  }
}

/// Within a burst the offset is constant, from burst to burst another, and nothing flags it.
TEST(MagneticBursts, AreConstantEachDifferentAndUnflagged) {
  auto series = silent(even_times(36000, 10.0));
  series.mag_valid.assign(series.size(), 1.0);
  effects::MagneticBursts{.bursts_per_hour = 60.0, .mean_duration_s = 20.0}.apply(series, {1, 0});
  double changes = 0.0;
  for (std::size_t i = 1; i < series.size(); ++i)
    changes += series.heading_deg[i] != series.heading_deg[i - 1];
  EXPECT_GT(changes, 0.0);
  EXPECT_LT(changes, 200.0);  // two a burst, of which there are 45 in the mean
  const std::set<double> offsets(series.heading_deg.begin(), series.heading_deg.end());
  EXPECT_GE(static_cast<double>(offsets.size()), 0.5 * changes);  // one a burst, and 0
  EXPECT_TRUE(std::all_of(series.mag_valid.begin(), series.mag_valid.end(),
                          [](double valid) { return valid == 1.0; }));
}

}  // namespace
}  // namespace gyrostat::compass_effects_test
