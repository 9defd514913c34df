#include <gyrostat/analysis/statistics/paired.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::paired_test {
namespace {

std::vector<double> normals(std::uint32_t trial, const char* stream, std::size_t count,
                            double mean) {
  std::vector<double> out(count);
  Noise{11, trial}.stream(stream).fill(0, out);
  for (double& v : out) v += mean;
  return out;
}

TEST(PairedDifference, AgreesWithTheHandComputedInterval) {
  // d = 1, 2, 3: mean 2, std 1, t(0.975, 2) = 4.302653.
  const std::vector<double> a = {2, 4, 6}, b = {1, 2, 3};
  const auto d = paired_difference(a, b, 1);
  EXPECT_EQ(d.count, 3U);
  EXPECT_DOUBLE_EQ(d.mean, 2.0);
  EXPECT_NEAR(d.high - 2.0, 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(2.0 - d.low, 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(d.p_adjusted, 0.0741799, 1e-6);
  EXPECT_FALSE(d.separable);
}

TEST(PairedDifference, ItsProbabilityIsThatOfItsInterval) {
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    auto a = normals(trial, "a", 30, 0.3);
    for (double& v : a) v = v * v;  // skewed
    const auto b = normals(trial, "b", 30, 0.6);
    const auto d = paired_difference(a, b, 3);
    EXPECT_EQ(d.separable, d.p_adjusted < 0.05) << trial;
  }
}

TEST(PairedDifference, DoesNotSeeWhatBothTrialsShare) {
  const auto shared = normals(0, "shared", 50, 0.0);
  std::vector<double> a = shared, b = shared;
  for (double& v : a) v = 100.0 * v + 1.0;
  for (double& v : b) v = 100.0 * v;
  const auto d = paired_difference(a, b, 10);
  EXPECT_NEAR(d.mean, 1.0, 1e-10);
  EXPECT_TRUE(d.separable);
}

TEST(PairedDifference, LeavesOutTrialsWhereEitherHasNoValue) {
  const std::vector<double> a = {1, no_value, 3, 4}, b = {0, 1, no_value, 2};
  const auto d = paired_difference(a, b, 1);
  EXPECT_EQ(d.count, 2U);
  EXPECT_DOUBLE_EQ(d.mean, 1.5);
}

// 1000 families of 6 null comparisons: the rate of families with any separation has expectation of
// at most 0.05 and standard error 0.007; 0.075 is exceeded by chance with probability below 2e-4.
TEST(PairedDifference, FindsNothingInNothingWhateverThePairPicked) {
  int families_with_a_find = 0;
  for (std::uint32_t trial = 0; trial < 1000; ++trial) {
    std::vector<std::vector<double>> methods;
    for (const char* name : {"a", "b", "c", "d"}) methods.push_back(normals(trial, name, 40, 0.0));
    bool found = false;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        found = found || paired_difference(methods[i], methods[j], 6).separable;
    families_with_a_find += found;
  }
  EXPECT_LE(families_with_a_find, 75);
  EXPECT_GE(families_with_a_find, 10);
}

// 400 studies with the number of trials that `trials_needed` asked for at the true effect: the
// power has a standard error of 0.02, so 0.74-0.86 fails by chance with probability 0.003.
TEST(PairedDifference, AsksForTheTrialsThatItTakes) {
  const double effect = 0.25;
  const double reach = 2.6383 + 0.8416;  // normal quantiles of 1 - 0.025 / 6 and of 0.8
  const auto trials = static_cast<std::size_t>(std::ceil(2.0 * reach * reach / (effect * effect)));
  int found = 0;
  for (std::uint32_t study = 0; study < 400; ++study)
    found +=
        paired_difference(normals(study, "p", trials, effect), normals(study, "q", trials, 0.0), 6)
            .separable;
  EXPECT_GE(found, 0.74 * 400);
  EXPECT_LE(found, 0.86 * 400);
}

}  // namespace
}  // namespace gyrostat::paired_test
