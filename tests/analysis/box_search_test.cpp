#include <gyrostat/analysis/search/box_search.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace gyrostat::box_search_test {
namespace {

double rosenbrock(const std::vector<double>& x) {
  return 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
}

TEST(BoxSearch, FindsTheMinimumOfACurvedValley) {
  const auto found = box_search({{-2, 2}, {-1, 3}}, 300, rosenbrock);
  EXPECT_NEAR(found.values[0], 1.0, 1e-3);
  EXPECT_NEAR(found.values[1], 1.0, 2e-3);
}

TEST(BoxSearch, SearchesPositiveRangesByTheirLogarithm) {
  const auto found = box_search({{1e-6, 1.0}}, 60,
                                [](const auto& x) { return std::pow(std::log(x[0] / 3e-5), 2); });
  EXPECT_NEAR(found.values[0], 3e-5, 1e-7);
}

TEST(BoxSearch, FindsAMinimumOnTheEdge) {
  const auto found = box_search({{0, 1}, {0, 1}}, 100, [](const auto& x) { return x[0] - x[1]; });
  EXPECT_NEAR(found.values[0], 0.0, 1e-3);
  EXPECT_NEAR(found.values[1], 1.0, 1e-3);
}

TEST(BoxSearch, SpendsExactlyItsBudgetAndNeverLeavesTheBox) {
  int calls = 0;
  const auto found = box_search({{2, 3}, {-5, -4}, {0.1, 10}}, 77, [&](const auto& x) {
    ++calls;
    EXPECT_TRUE(x[0] >= 2 && x[0] <= 3 && x[1] >= -5 && x[1] <= -4);
    EXPECT_TRUE(x[2] >= 0.1 * (1 - 1e-12) && x[2] <= 10 * (1 + 1e-12));
    return x[0] * x[1] + x[2];
  });
  EXPECT_EQ(calls, 77);
  EXPECT_EQ(found.evaluations, 77);
}

TEST(BoxSearch, TakesNoValueForTheWorst) {
  const auto found = box_search({{-1, 1}}, 60, [](const auto& x) {
    return x[0] < 0 ? std::nan("") : std::pow(x[0] - 0.25, 2);
  });
  EXPECT_NEAR(found.values[0], 0.25, 1e-3);
}

}  // namespace
}  // namespace gyrostat::box_search_test
