#include <gyrostat/analysis/statistics/all_pairs.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/distributions/students_t.hpp>
#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::all_pairs_test {
namespace {

using Trials = std::vector<std::vector<double>>;

AllPairs pairs_of(const Trials& trials, double looks = 1.0) {
  AllPairs pairs(trials.empty() ? 2 : trials.front().size(), looks);
  do
    for (const auto& trial : trials) pairs.add(trial);
  while (pairs.another_pass());
  return pairs;
}

/// Methods whose sample covariance is the identity to rounding: cosines over the trials.
Trials uncorrelated(std::size_t methods, std::size_t trials) {
  Trials all(trials, std::vector<double>(methods));
  for (std::size_t j = 0; j < trials; ++j)
    for (std::size_t m = 0; m < methods; ++m)
      all[j][m] = std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) *
                           static_cast<double>(m + 1) / static_cast<double>(trials));
  return all;
}

double critical(const AllPairs& pairs, std::size_t trials) {
  const boost::math::students_t t(static_cast<double>(trials) - 1.0);
  return boost::math::quantile(boost::math::complement(t, 0.025 / pairs.comparisons()));
}

TEST(AllPairs, IsThePlainIntervalOfTheOnlyPair) {
  const auto pairs = pairs_of({{2, 1}, {4, 2}, {6, 3}});
  const auto expected = paired_difference(std::vector{2., 4., 6.}, std::vector{1., 2., 3.}, 1);
  const auto d = pairs.difference(0, 1);
  EXPECT_EQ(d.count, 3U);
  EXPECT_DOUBLE_EQ(d.mean, expected.mean);
  EXPECT_DOUBLE_EQ(d.low, expected.low);
  EXPECT_DOUBLE_EQ(d.high, expected.high);
  EXPECT_DOUBLE_EQ(d.p_adjusted, expected.p_adjusted);
  const auto turned = pairs.difference(1, 0);
  EXPECT_DOUBLE_EQ(turned.mean, -expected.mean);
  EXPECT_DOUBLE_EQ(turned.low, -expected.high);
  EXPECT_DOUBLE_EQ(turned.high, -expected.low);
}

// For methods that are alike and independent, max |t| is Tukey's studentised range over the root of
// two. Its 95 % points for infinitely many degrees of freedom, 3.314, 3.633 and 4.030, and for 20,
// 3.958 (4 methods), stand in every table. The draws' quantile has a standard error of at most
// 0.013: five of them.
TEST(AllPairs, IsTheStudentisedRangeOfMethodsThatAreAlike) {
  constexpr std::size_t many = 20001;
  const double root = std::numbers::sqrt2;
  EXPECT_NEAR(critical(pairs_of(uncorrelated(3, many)), many), 3.314 / root, 0.065);
  EXPECT_NEAR(critical(pairs_of(uncorrelated(4, many)), many), 3.633 / root, 0.065);
  EXPECT_NEAR(critical(pairs_of(uncorrelated(6, many)), many), 4.030 / root, 0.065);
  EXPECT_NEAR(critical(pairs_of(uncorrelated(4, 21)), 21), 3.958 / root, 0.065);
}

// Methods that differ by a constant alone differ from another by the same error: one comparison.
TEST(AllPairs, CountsOnceWhatErrsTogether) {
  auto trials = uncorrelated(5, 2000);
  for (auto& trial : trials)
    for (std::size_t m = 2; m < 5; ++m) trial[m] = trial[1] + static_cast<double>(m);
  EXPECT_NEAR(pairs_of(trials).comparisons(), 1.0, 0.1);
}

TEST(AllPairs, CountsOneByOneWhatIsAllButTheSame) {
  auto trials = uncorrelated(3, 2000);
  for (auto& trial : trials) trial[2] = trial[1] + 1e-8 * trial[2];
  EXPECT_NEAR(pairs_of(trials).comparisons(), 2.0, 0.1);
}

TEST(AllPairs, LooksWidenTheIntervals) {
  const auto trials = uncorrelated(4, 200);
  const double once = pairs_of(trials).comparisons(), often = pairs_of(trials, 4.0).comparisons();
  EXPECT_GT(often, 3.0 * once);
  EXPECT_LE(often, 4.0 * 6.0);
  EXPECT_DOUBLE_EQ(pairs_of(trials, 1000.0).comparisons(), 6000.0);  // too far out to be drawn
}

TEST(AllPairs, LeavesOutWhatHasNoValue) {
  const auto pairs = pairs_of({{1, 2, no_value}, {no_value, 1, 1}, {3, 1, no_value}, {4, 0, 2}});
  EXPECT_EQ(pairs.difference(0, 1).count, 3U);
  EXPECT_EQ(pairs.difference(2, 0).count, 1U);
  EXPECT_TRUE(std::isnan(pairs.difference(2, 0).low));
  EXPECT_EQ(pairs.difference(2, 1).count, 2U);
  EXPECT_TRUE(std::isnan(pairs_of({}).difference(0, 1).mean));
}

// 1000 families of 4 methods in 30 trials, with a share in common, and of unlike spread: the rate
// of families with a separation has a standard error of 0.007 about 0.05; outside 0.022 to 0.078 by
// chance with probability below 1e-4.
TEST(AllPairs, FindsNothingInNothingOnceInTwentyFamilies) {
  int found = 0;
  for (std::uint32_t family = 0; family < 1000; ++family) {
    Trials trials(30, std::vector<double>(4));
    const auto stream = Noise{5, family}.stream("families");
    std::vector<double> z(5);
    for (std::size_t k = 0; k < trials.size(); ++k) {
      stream.fill(5 * k, z);
      for (std::size_t m = 0; m < 4; ++m) trials[k][m] = z[4] + static_cast<double>(m + 1) * z[m];
    }
    const auto pairs = pairs_of(trials);
    bool any = false;
    for (std::size_t a = 1; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) any = any || pairs.difference(a, b).separable;
    found += any;
  }
  EXPECT_GE(found, 22);
  EXPECT_LE(found, 78);
}

}  // namespace
}  // namespace gyrostat::all_pairs_test
