#include <gyrostat/diagnosis/likelihood/log_bessel.hpp>

#include <cmath>
#include <numbers>

#include <boost/math/special_functions/bessel.hpp>

namespace gyrostat::gap {

double log_bessel_i0(double x) {
  using boost::math::policies::policy, boost::math::policies::promote_double;
  if (x < 30.0) return std::log(boost::math::cyl_bessel_i(0, x, policy<promote_double<false>>()));
  return x - 0.5 * std::log(2.0 * std::numbers::pi * x) + 0.125 / x;
}

}  // namespace gyrostat::gap
