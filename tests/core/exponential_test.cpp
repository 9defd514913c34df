// The exponential of packs against the library's.

#include <gyrostat/core/packed/exponential.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <gyrostat/core/packed/target.hpp>

namespace gyrostat::exponential_test {
namespace {

using Lanes = Pack<targets::Sse2, 4>;

double worst_between(double from, double to) {
  constexpr int count = 200'000;
  double worst = 0.0;
  for (int k = 0; k < count; ++k) {
    const double x = from + (to - from) * k / count;
    const double exact = std::exp(x);
    worst = std::max(worst, std::abs(exp_of_negative(Lanes(x))[k % 4] - exact) / exact);
  }
  return worst;
}

TEST(ExpOfNegative, IsTheLibrarysWithinThreeUnitsInTheLastPlace) {
  constexpr double three_units = 3.0 * std::numeric_limits<double>::epsilon();
  EXPECT_EQ(exp_of_negative(Lanes(0.0))[0], 1.0);
  EXPECT_LT(worst_between(-1.0, 0.0), three_units);
  EXPECT_LT(worst_between(-700.0, 0.0), three_units);
}

TEST(ExpOfNegative, IsLeastBelowItsRangeAndKeepsWhatIsNoNumber) {
  EXPECT_GT(exp_of_negative(Lanes(-1e300))[1], 0.0);
  EXPECT_LT(exp_of_negative(Lanes(-1e300))[1], 1e-303);
  EXPECT_TRUE(std::isnan(exp_of_negative(Lanes(std::nan("")))[2]));
}

}  // namespace
}  // namespace gyrostat::exponential_test
