#include <gyrostat/analysis/statistics/sequential.hpp>

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace gyrostat::sequential_test {
namespace {

using testing::ElementsAre;

TEST(LookCounts, AreGeometricAndDoNotDependOnTheEnd) {
  EXPECT_THAT(look_counts(100, 1000), ElementsAre(100, 140, 200, 280, 400, 560, 800));
  EXPECT_THAT(look_counts(100, 300), ElementsAre(100, 140, 200, 280));
  EXPECT_THAT(look_counts(100, 99), ElementsAre());
}

TEST(SequentialBounds, DoNotDependOnLaterLooks) {
  const auto few = sequential_bounds(look_counts(100, 400), 0.05);
  const auto many = sequential_bounds(look_counts(100, 100000), 0.05);
  for (std::size_t k = 0; k < few.size(); ++k) EXPECT_EQ(few[k], many[k]);
}

/// By the multivariate normal distribution of SciPy: tests/reference/ranking_reference.py.
TEST(SequentialBounds, AgreeWithSciPy) {
  const auto bounds = sequential_bounds(look_counts(100, 400), 0.05);
  const double expected[] = {2.2414, 2.3753, 2.568, 2.7275, 2.8757};
  ASSERT_EQ(bounds.size(), std::size(expected));
  for (std::size_t k = 0; k < bounds.size(); ++k) EXPECT_NEAR(bounds[k], expected[k], 2e-3) << k;
}

/// A walk without drift looked at twelve times leaves its bounds with probability alpha 12 / 13.
/// With 20,000 walks the standard error is 0.15 %: beyond 5 of them by chance in under one of a
/// million.
TEST(SequentialBounds, AreLeftAsOftenAsTheySay) {
  const auto counts = look_counts(50, 2500);
  const auto bounds = sequential_bounds(counts, 0.05);
  ASSERT_EQ(counts.size(), 12U);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr int walks = 20000;
  int left = 0;
  for (int w = 0; w < walks; ++w) {
    double sum = 0.0, before = 0.0;
    bool out = false;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      sum += std::sqrt(counts[k] - before) * normal(random);
      before = counts[k];
      out = out || std::abs(sum) > bounds[k] * std::sqrt(before);
    }
    left += out;
  }
  const double wanted = 0.05 * 12.0 / 13.0;
  EXPECT_NEAR(static_cast<double>(left) / walks, wanted, 5.0 * std::sqrt(wanted / walks));
}

}  // namespace
}  // namespace gyrostat::sequential_test
