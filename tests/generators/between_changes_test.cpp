// Noise has no changes; those of its strength are found to the sample.

#include <gyrostat/generators/between_changes.hpp>

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::between_changes_test {
namespace {

std::vector<double> squares(const std::vector<double>& deviation, std::uint64_t seed) {
  const NormalStream stream(seed, 0, "squares");
  std::vector<double> all;
  for (std::size_t i = 0; i < deviation.size(); ++i)
    all.push_back(std::pow(deviation[i] * stream.normal(i), 2));
  return all;
}

/// A price of 6 log(blocks) asks for a chi-square of 32 at one of 200 places: once in 1e6 draws of
/// normal logarithms, and those of sums of 20 squares have somewhat longer tails.
TEST(BetweenChanges, NoiseHasNone) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto means = between_changes(squares(std::vector<double>(4000, 2.0), seed), 20);
    EXPECT_EQ(means.front(), means.back()) << seed;
    EXPECT_NEAR(means.front(), 4.0, 5.0 * 4.0 * std::sqrt(2.0 / 4000.0));
  }
}

/// From 1 to 3 the likeliest sample is the true one within 5 but once in 1e4; the means have the
/// standard error of their stretch, and 5 of them are allowed.
TEST(BetweenChanges, AreFoundToTheSample) {
  std::vector<double> deviation(1010, 1.0);
  deviation.resize(2333, 3.0);
  deviation.resize(4000, 0.5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto means = between_changes(squares(deviation, seed), 20);
    ASSERT_EQ(means.size(), 4000);
    EXPECT_EQ(std::set<double>(means.begin(), means.end()).size(), 3) << seed;
    for (const std::size_t edge : {1010, 2333}) {
      EXPECT_NEAR(means[edge - 10], std::pow(deviation[edge - 10], 2),
                  0.25 * std::pow(deviation[edge - 10], 2));
      EXPECT_NEAR(means[edge + 10], std::pow(deviation[edge + 10], 2),
                  0.25 * std::pow(deviation[edge + 10], 2));
    }
  }
}

TEST(BetweenChanges, OfNothingAndOfFewIsWhatTheyAre) {
  EXPECT_TRUE(between_changes({}, 20).empty());
  const std::vector<double> few = {1.0, 2.0, 3.0}, none(100, 0.0);
  EXPECT_EQ(between_changes(few, 20), few);
  EXPECT_EQ(between_changes(none, 20), none);
}

}  // namespace
}  // namespace gyrostat::between_changes_test
