#include <gyrostat/core/words.hpp>

#include <limits>

#include <gtest/gtest.h>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::words_test {
namespace {

TEST(Words, OneIsNoPlural) {
  EXPECT_EQ(counted(1, "cell"), "1 cell");
  EXPECT_EQ(counted(0, "cell"), "0 cells");
  EXPECT_EQ(counted(21, "trial"), "21 trials");
}

TEST(Words, AChanceSaysNoMoreThanAnyTestKnows) {
  EXPECT_EQ(chance_in_words(0.0213), "= 0.021");
  EXPECT_EQ(chance_in_words(3.14e-5), "= 3.1e-5");
  EXPECT_EQ(chance_in_words(1e-58), "< 1e-6");
  EXPECT_EQ(chance_in_words(0.0), "< 1e-6");
  EXPECT_EQ(chance_in_words(1.0), "= 1");
}

TEST(Words, ARangeHasItsUnitBesideItsNumbers) {
  EXPECT_EQ(values_in_words(Range{.from = 1, .to = 1e8, .whole = true}, "trials"),
            "[1, 1e8] trials, whole numbers");
  EXPECT_EQ(values_in_words(Range{.from = -1e-6, .to = 1e12}, "1"), "[-1e-6, 1e12]");
  EXPECT_EQ(values_in_words(Range{.from = 1e100, .to = 2e120}), "[1e100, 2e120]");
  EXPECT_EQ(values_in_words(ranges::positive, "dps"), "(0, inf) dps");
  EXPECT_EQ(values_in_words(ranges::stationary), "(-1, 1)");
}

}  // namespace
}  // namespace gyrostat::words_test
