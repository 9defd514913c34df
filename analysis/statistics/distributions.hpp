#pragma once

namespace gyrostat {

/// The distributions that statistics here go by (Boost.Math). A quantile is of the probability
/// below it; an upper quantile, of that above, keeps its digits where that is small, as does an
/// upper tail. `degrees` of freedom need not be whole.

double normal_quantile(double probability);
double normal_upper_quantile(double tail);
double normal_upper_tail(double x);

/// How many standard errors an interval reaches to each side.
double student_t_two_sided(double confidence, double degrees);
double student_t_upper_quantile(double tail, double degrees);
double student_t_upper_tail(double t, double degrees);

double chi_squared_quantile(double probability, double degrees);
double chi_squared_upper_quantile(double tail, double degrees);
double chi_squared_cdf(double x, double degrees);
double chi_squared_upper_tail(double x, double degrees);

double digamma(double x);
double trigamma(double x);

}  // namespace gyrostat
