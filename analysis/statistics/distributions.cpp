#include <gyrostat/analysis/statistics/distributions.hpp>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

namespace gyrostat {

using boost::math::chi_squared;
using boost::math::complement;
using boost::math::students_t;
/// Draws of many values ask for it: in long double, as Boost has it, they take three times as long.
using normal = boost::math::normal_distribution<
    double, boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

double normal_quantile(double probability) { return quantile(normal(), probability); }
double normal_upper_quantile(double tail) { return quantile(complement(normal(), tail)); }
double normal_upper_tail(double x) { return cdf(complement(normal(), x)); }

double student_t_two_sided(double confidence, double degrees) {
  return quantile(students_t(degrees), 0.5 + confidence / 2.0);
}
double student_t_upper_quantile(double tail, double degrees) {
  return quantile(complement(students_t(degrees), tail));
}
double student_t_upper_tail(double t, double degrees) {
  return cdf(complement(students_t(degrees), t));
}

double chi_squared_quantile(double probability, double degrees) {
  return quantile(chi_squared(degrees), probability);
}
double chi_squared_upper_quantile(double tail, double degrees) {
  return quantile(complement(chi_squared(degrees), tail));
}
double chi_squared_cdf(double x, double degrees) { return cdf(chi_squared(degrees), x); }
double chi_squared_upper_tail(double x, double degrees) {
  return cdf(complement(chi_squared(degrees), x));
}

double digamma(double x) { return boost::math::digamma(x); }
double trigamma(double x) { return boost::math::trigamma(x); }

}  // namespace gyrostat
