// Allan variances of laws against sums over autocovariances and closed forms of IEEE Std 952.

#include <gyrostat/diagnosis/likelihood/law_allan.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace gyrostat::law_allan_test {
namespace {

constexpr double interval_s = 0.02;

TEST(LawAllan, WhiteNoiseAWalkAndARoundedAngleAreInClosedForm) {
  gap::NoiseLaw law{.interval_s = interval_s, .white = 0.04, .walk = 3e-4, .rounding = 0.01};
  for (const std::size_t m : {1, 2, 7, 50, 4000}) {
    const auto n = static_cast<double>(m);
    const double step = 3e-4 * interval_s;
    EXPECT_NEAR(gap::allan_variance(law, m), 0.05 / n + step * (2.0 * n * n + 1.0) / (6.0 * n),
                1e-12);
  }
  const gap::NoiseLaw angle{.interval_s = interval_s, .angle = 2.0 * 0.09};
  EXPECT_NEAR(gap::allan_variance(angle, 5), 3.0 * 0.09 / 25.0, 1e-12);  // 3 Q² / tau²
}

/// 2 s² (1 - (3 - 4 e^-u + e^-2u) / (2 u)) / u with u = tau / T, of a continuous process.
TEST(LawAllan, OfAGaussMarkovProcessIsThatOfIeee952) {
  const gap::NoiseLaw law{.interval_s = interval_s, .decaying = {{0.25, 40.0 * interval_s}}};
  for (const std::size_t m : {20, 40, 200, 1000}) {
    const double u = static_cast<double>(m) / 40.0;
    const double expected =
        2.0 * 0.25 / u * (1.0 - (3.0 - 4.0 * std::exp(-u) + std::exp(-2.0 * u)) / (2.0 * u));
    EXPECT_NEAR(gap::allan_variance(law, m) / expected, 1.0, 0.03) << m;
  }
}

TEST(LawAllan, OfALineFallsAsTheSquareOfTheAveragingTime) {
  const gap::NoiseLaw law{.interval_s = interval_s, .resonances = {{0.01, 5.0, 0.05}}};
  // Half a period, 5 samples: neighbouring means have opposite signs.
  const double peak = gap::allan_variance(law, 5);
  EXPECT_GT(peak, 0.004);
  EXPECT_LT(gap::allan_variance(law, 500), 1e-3 * peak);
}

/// A frequency that forgets at once leaves a resonance of the width 4 pi wander² T.
TEST(LawAllan, OfALineThatWandersFastIsThatOfAResonance) {
  const double wander_hz = 2.0, memory_s = 1e-3;
  const gap::NoiseLaw line{.interval_s = interval_s,
                           .wandering = {{std::sqrt(2.0 * 0.01), 5.0, wander_hz, memory_s}}};
  const gap::NoiseLaw band{
      .interval_s = interval_s,
      .resonances = {{0.01, 5.0, 4.0 * std::numbers::pi * wander_hz * wander_hz * memory_s}}};
  for (const std::size_t m : {1, 5, 15, 100})
    EXPECT_NEAR(gap::allan_variance(line, m) / gap::allan_variance(band, m), 1.0, 0.01) << m;
}

TEST(LawAllan, AFilterLowersItAtShortTimesAndLeavesTheDensity) {
  gap::NoiseLaw law{.interval_s = interval_s, .white = 1.0};
  law.filter = effects::NoiseBandwidth{.cutoff_hz = 2.0};
  EXPECT_LT(gap::allan_variance(law, 1), 0.15);
  EXPECT_NEAR(500.0 * gap::allan_variance(law, 500), 1.0, 0.03);
  // Of one pole: the sum over a geometric autocovariance.
  const double pole = std::exp(-2.0 * std::numbers::pi * 2.0 * interval_s);
  const double c0 = (1.0 - pole) / (1.0 + pole);
  EXPECT_NEAR(gap::allan_variance(law, 1), c0 * (1.0 - pole), 1e-6);
}

}  // namespace
}  // namespace gyrostat::law_allan_test
