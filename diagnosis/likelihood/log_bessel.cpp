#include <gyrostat/diagnosis/likelihood/log_bessel.hpp>

#include <array>
#include <cmath>

#include <boost/math/special_functions/bessel.hpp>

namespace gyrostat::gap {

Scaled bessel_i0(double x) {
  using boost::math::policies::policy, boost::math::policies::promote_double;
  if (x < 7.75) return {boost::math::cyl_bessel_i(0, x, policy<promote_double<false>>()), 0.0};
  constexpr std::array series = {0.39894228,  0.01328592, 0.00225319,  -0.00157565, 0.00916281,
                                 -0.02057706, 0.02635537, -0.01647633, 0.00392377};
  const double inverse = 3.75 / x;
  double sum = 0.0;
  for (std::size_t k = series.size(); k-- > 0;) sum = sum * inverse + series[k];
  return {sum / std::sqrt(x), x};
}

double log_bessel_i0(double x) {
  const auto scaled = bessel_i0(x);
  return scaled.exponent + std::log(scaled.factor);
}

}  // namespace gyrostat::gap
