#include <gyrostat/diagnosis/likelihood/log_bessel.hpp>

#include <cmath>

#include <boost/math/special_functions/bessel.hpp>
#include <gtest/gtest.h>

namespace gyrostat::gap::log_bessel_test {

TEST(BesselI0, IsThatOfTheLibraryWithinWhatItSays) {
  for (double x = 0.0; x < 700.0; x += 0.37) {
    const double expected = std::log(boost::math::cyl_bessel_i(0, x));
    EXPECT_NEAR(log_bessel_i0(x), expected, 5e-7) << x;
    const auto scaled = bessel_i0(x);
    EXPECT_NEAR(scaled.exponent + std::log(scaled.factor), expected, 5e-7) << x;
  }
  EXPECT_NEAR(log_bessel_i0(1e6), 1e6 - 0.5 * std::log(2e6 * std::acos(-1.0)) + 0.125e-6, 5e-7);
}

}  // namespace gyrostat::gap::log_bessel_test
