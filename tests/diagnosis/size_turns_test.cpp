// Innovations whose size goes round.

#include <gyrostat/diagnosis/likelihood/size_turns.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap::size_turns_test {
namespace {

double turns_at(double per_sample, double depth) {
  constexpr std::size_t n = 20000;
  const NormalStream noise(3, 0, "innovations");
  std::vector<std::size_t> samples;
  std::vector<double> squares;
  for (std::size_t i = 0; i < n; ++i) {
    const double turn = 2.0 * std::numbers::pi * per_sample * static_cast<double>(i);
    samples.push_back(i);
    squares.push_back(std::pow(noise.normal(i), 2) * (1.0 + depth * std::cos(turn)));
  }
  return turns_of(samples, squares, 1.0);
}

/// To half of what 32,768 places of the transform resolve. A depth of .3 is that of straight lines
/// between samples (2 / pi^2 of 2 / 3): its line has 20000 .3^2 / 4 / 2 = 225 times the power of
/// what is beside it, and 40 times is exceeded by chance once in e^40 / 10,000.
TEST(SizeTurns, AreFoundWhereTheyAre) {
  for (const double turns : {0.0042, 0.0421, 0.29})
    EXPECT_NEAR(turns_at(turns, 0.3), turns, 0.5 / 32768.0 + 1e-12);
}

TEST(SizeTurns, AreNoneOfEvenNoiseNorOfAFewSamplesNorOfBursts) {
  EXPECT_EQ(turns_at(0.1, 0.0), 0.0);
  EXPECT_EQ(turns_at(0.37, 0.3), 0.0);
  EXPECT_EQ(turns_at(0.0005, 0.3), 0.0);
}

}  // namespace
}  // namespace gyrostat::gap::size_turns_test
