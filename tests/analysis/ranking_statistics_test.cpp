#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include <gyrostat/analysis/statistics/mean_ranks.hpp>
#include <gyrostat/analysis/statistics/tail_mean.hpp>

namespace gyrostat::ranking_statistics_test {
namespace {

using testing::ElementsAre;

/// scipy.stats.studentized_range.ppf(0.95, k, inf): tests/reference/ranking_reference.py.
TEST(StudentisedRange, AgreesWithSciPy) {
  EXPECT_NEAR(studentised_range_quantile(0.95, 2), 2.77180765, 1e-6);
  EXPECT_NEAR(studentised_range_quantile(0.95, 3), 3.31449316, 1e-6);
  EXPECT_NEAR(studentised_range_quantile(0.95, 5), 3.85765551, 1e-6);
  EXPECT_NEAR(studentised_range_quantile(0.95, 10), 4.47412422, 1e-6);
  EXPECT_NEAR(studentised_range_quantile(0.95, 20), 5.01168879, 1e-6);
}

TEST(MidRanks, ShareTiesAndPutWhatIsMissingLast) {
  EXPECT_THAT(mid_ranks(std::vector{3.0, 1.0, 3.0, 2.0}), ElementsAre(3.5, 1.0, 3.5, 2.0));
  EXPECT_THAT(mid_ranks(std::vector{no_value, 1.0, no_value}), ElementsAre(2.5, 1.0, 2.5));
}

/// Five trials of four methods with ties, by scipy.stats.friedmanchisquare: same script.
TEST(RankStatistics, FriedmansTestAgreesWithSciPy) {
  RankStatistics ranks(4);
  for (const auto& trial : std::vector<std::vector<double>>{
           {1, 2, 3, 3}, {2, 1, 4, 4}, {1, 1, 2, 5}, {3, 2, 4, 6}, {1, 5, 6, 7}})
    ranks.add(trial);
  EXPECT_NEAR(ranks.friedman_p(), 0.0039553738829327684, 1e-12);
  EXPECT_NEAR(ranks.mean_rank(2), 3.2, 1e-12);
  // Demsar 2006, table 5: 2.569 for four methods.
  EXPECT_NEAR(ranks.critical_difference(), 2.569 * std::sqrt(4.0 * 5.0 / (6.0 * 5.0)), 1e-3);
}

TEST(RankStatistics, WhatIsAlwaysTiedIsAlike) {
  RankStatistics ranks(3);
  for (int i = 0; i < 10; ++i) ranks.add(std::vector{1.0, 1.0, 1.0});
  EXPECT_EQ(ranks.friedman_p(), 1.0);
  EXPECT_EQ(ranks.mean_rank(0), 2.0);
}

TailMean tail_of(const std::vector<double>& values) {
  StreamedTailMean tail;
  do
    for (const double v : values) tail.add(v);
  while (tail.another_pass());
  return tail.tail();
}

TEST(TailMean, IsTheMeanOfTheWorstTwentieth) {
  std::vector<double> values;
  for (int i = 1; i <= 1000; ++i) values.push_back(i);
  values.push_back(no_value);
  // The quantile is 950.05; the fifty values above it have mean 975.5.
  EXPECT_NEAR(tail_of(values).value, 975.5, 0.1);
  EXPECT_LT(tail_of(values).low, 975.5);
  EXPECT_GT(tail_of(values).high, 975.5);
}

TEST(TailMean, OfFewValuesHasNoInterval) {
  EXPECT_TRUE(std::isnan(tail_of(std::vector<double>(100, 1.0)).low));
  EXPECT_TRUE(std::isnan(tail_of({}).value));
}

/// The tail mean of the exponential distribution is 1 - ln 0.05. The interval covers it in 95 % of
/// samples: with 2000 of them the standard error is 0.5 %, and 93 to 97 % is missed by chance in
/// under one of 10^4.
TEST(TailMean, ItsIntervalCoversTheTruthInNineteenOfTwentySamples) {
  std::mt19937_64 random(5);
  std::exponential_distribution<double> draw;
  constexpr int samples = 2000;
  int hits = 0;
  for (int s = 0; s < samples; ++s) {
    std::vector<double> values(400);
    for (double& v : values) v = draw(random);
    const auto tail = tail_of(values);
    hits += tail.low <= 1.0 - std::log(0.05) && 1.0 - std::log(0.05) <= tail.high;
  }
  EXPECT_GE(hits, 0.93 * samples);
  EXPECT_LE(hits, 0.97 * samples);
}

}  // namespace
}  // namespace gyrostat::ranking_statistics_test
