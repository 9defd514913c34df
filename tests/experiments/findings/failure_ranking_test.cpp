#include <gyrostat/experiments/findings/failure_ranking.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace gyrostat::failure_ranking_test {
namespace {

FailureFinding counted(const std::string& method, std::uint32_t failing, std::uint32_t trials) {
  return {method, {failing, trials}, {}, {}, {}};
}

TEST(FailureRanking, ABoundRanksWhereItIsAndWhatIsNotToldIsLast) {
  auto bounded = counted("bounded", 0, 1000);
  bounded.rarer_than = 2e-6;
  auto rare = counted("rare", 0, 1000);
  rare.rare = RareProbability{.probability = 1e-5, .low = 5e-6, .high = 2e-5, .variation = 0.3};
  const auto ranking =
      rank_failures({counted("often", 400, 1000), counted("not told", 3, 1000), rare, bounded});
  std::vector<std::string> order;
  for (const auto& f : ranking) order.push_back(f.method);
  EXPECT_THAT(order, testing::ElementsAre("bounded", "rare", "often", "not told"));
  // Only rare and often are told: 40,000 times as often.
  const auto ratios = failure_ratios(ranking);
  ASSERT_EQ(ratios.size(), 1U);
  EXPECT_TRUE(ratios[0].separable());
  EXPECT_LT(ratios[0].low, 4e4);
  EXPECT_GT(ratios[0].high, 4e4);
}

/// Of two methods that fail as often, each counted in trials of its own, one is told as better in
/// 5 % of studies: 400 of them, standard error 1.1 %, so that four fail once in 30,000. One that
/// fails half as often always is, twelve standard errors away.
TEST(FailureRanking, SeparatesEqualsAsRarelyAsItSays) {
  constexpr int studies = 400;
  constexpr std::uint32_t trials = 20000;
  std::mt19937_64 random(3);
  const auto drawn = [&](double p) {
    return std::binomial_distribution<std::uint32_t>(trials, p)(random);
  };
  int equals = 0, halves = 0;
  for (int study = 0; study < studies; ++study) {
    const auto a = counted("a", drawn(0.02), trials), b = counted("b", drawn(0.02), trials),
               c = counted("c", drawn(0.01), trials);
    equals += failure_ratios(rank_failures({a, b})).at(0).separable();
    halves += failure_ratios(rank_failures({a, c})).at(0).separable();
  }
  EXPECT_NEAR(equals / double{studies}, 0.05, 0.044);
  EXPECT_EQ(halves, studies);
}

/// Three pairs of one ranking need more to be told apart than one pair.
TEST(FailureRanking, IntervalsAllowForAllPairs) {
  const auto a = counted("a", 200, 20000), b = counted("b", 240, 20000),
             c = counted("c", 4000, 20000);
  const auto two = failure_ratios(rank_failures({a, b})).at(0);
  const auto three = failure_ratios(rank_failures({a, b, c})).at(0);
  EXPECT_LT(three.low, two.low);
  EXPECT_GT(three.high, two.high);
  EXPECT_LT(two.low, 1.2);
  EXPECT_GT(two.high, 1.2);
}

}  // namespace
}  // namespace gyrostat::failure_ranking_test
