// The p-value of the clearest witness: uniform under what chance shows, small where any of them is
// clear.

#include <gyrostat/diagnosis/significance.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap::significance_test {
namespace {

/// Lenses with a uniform p-value, and a find in as many recordings as chance has, its odds beyond
/// e^x with probability e^-x. A share of 40,000 has a standard error of 0.25 % at most: four of
/// them are missed once in 3,000 families of five.
TEST(Significance, IsUniformWhereThereIsNothing) {
  constexpr std::size_t count = 40'000;
  const NormalStream lenses(1, 0, "lenses"), finds(1, 0, "finds"), odds(1, 0, "odds");
  std::vector<double> p;
  for (std::size_t k = 0; k < count; ++k) {
    const bool found = finds.uniform(k) < thresholds::chance_of_a_find;
    p.push_back(
        p_of_the_clearest(lenses.uniform(k), 1.0, found ? -std::log(odds.uniform(k)) : -3.0));
  }
  for (const double level : {0.01, 0.05, 0.2, 0.5, 0.9}) {
    const auto below = std::count_if(p.begin(), p.end(), [&](double x) { return x <= level; });
    EXPECT_NEAR(static_cast<double>(below) / count, level,
                4.0 * std::sqrt(level * (1.0 - level) / count));
  }
}

TEST(Significance, IsSmallWhereAnyWitnessIsClear) {
  EXPECT_EQ(p_of_the_clearest(1.0, 1.0, 0.0), 1.0);
  for (const double p : {p_of_the_clearest(1e-12, 1.0, 0.0), p_of_the_clearest(1.0, 1e-12, 0.0),
                         p_of_the_clearest(1.0, 1.0, 25.0)}) {
    EXPECT_LT(p, 3e-12);
    EXPECT_GT(p, 1e-13);
  }
  EXPECT_EQ(p_of_the_clearest(0.0, 1.0, 0.0), 0.0);
}

}  // namespace
}  // namespace gyrostat::gap::significance_test
