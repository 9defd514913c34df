#include <gyrostat/analysis/search/covariance_search.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace gyrostat::covariance_search_test {
namespace {

/// Hansen's ellipsoid turned by Householder's reflection along (1, 1, ..., 1): axes as 1 to 1000
/// that no coordinate sees, minimum at 0.3.
double turned_ellipsoid(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  double mean = 0.0, value = 0.0;
  for (const double v : x) mean += (v - 0.3) / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double turned = x[i] - 0.3 - 2.0 * mean;
    value += std::pow(1e6, static_cast<double>(i) / (n - 1)) * turned * turned;
  }
  return value;
}

TEST(CovarianceSearch, FindsTheMinimumOfATurnedEllipsoidWhereASimplexStalls) {
  const std::vector<SearchRange> box(10, {-1.0, 2.0});
  const auto found = covariance_search(box, 6000, turned_ellipsoid);
  for (const double value : found.values) EXPECT_NEAR(value, 0.3, 1e-3);
  EXPECT_LT(1e4 * found.objective, box_search(box, 6000, turned_ellipsoid).objective);
}

TEST(CovarianceSearch, CountsOnlyTheOrderOfObjectives) {
  const std::vector<SearchRange> box(4, {-1.0, 2.0});
  const auto plain = covariance_search(box, 400, turned_ellipsoid);
  const auto bent =
      covariance_search(box, 400, [](const auto& x) { return -1.0 / (1.0 + turned_ellipsoid(x)); });
  EXPECT_EQ(plain.values, bent.values);
}

TEST(CovarianceSearch, FindsAMinimumOnTheEdge) {
  const auto found =
      covariance_search({{0, 1}, {0, 1}}, 400, [](const auto& x) { return x[0] - x[1]; });
  EXPECT_NEAR(found.values[0], 0.0, 1e-3);
  EXPECT_NEAR(found.values[1], 1.0, 1e-3);
}

/// The middle lies in a wide basin, which ends at 0; only a run from elsewhere meets the narrow
/// one.
TEST(CovarianceSearch, BeginsAnewWhereABasinHasCaughtIt) {
  const auto found = covariance_search({{0, 1}, {0, 1}}, 4000, [](const auto& x) {
    const auto to = [&](double a, double b) { return std::hypot(x[0] - a, x[1] - b); };
    return std::min(to(0.5, 0.5), to(0.93, 0.1) < 0.05 ? 20.0 * to(0.93, 0.1) - 1.0 : 1.0);
  });
  EXPECT_LT(found.objective, 0.0);
}

TEST(CovarianceSearch, SpendsExactlyItsBudgetAndNeverLeavesTheBox) {
  int calls = 0;
  const auto found = covariance_search({{2, 3}, {-5, -4}, {0.1, 10}}, 77, [&](const auto& x) {
    ++calls;
    EXPECT_TRUE(x[0] >= 2 && x[0] <= 3 && x[1] >= -5 && x[1] <= -4);
    EXPECT_TRUE(x[2] >= 0.1 * (1 - 1e-12) && x[2] <= 10 * (1 + 1e-12));
    return x[0] * x[1] + x[2];
  });
  EXPECT_EQ(calls, 77);
  EXPECT_EQ(found.evaluations, 77);
}

TEST(CovarianceSearch, TakesNoValueForTheWorst) {
  const auto found = covariance_search({{-1, 1}, {-1, 1}}, 400, [](const auto& x) {
    return x[0] < 0 ? std::nan("") : std::hypot(x[0] - 0.25, x[1]);
  });
  EXPECT_NEAR(found.values[0], 0.25, 1e-3);
}

}  // namespace
}  // namespace gyrostat::covariance_search_test
