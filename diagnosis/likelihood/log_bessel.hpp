#pragma once

namespace gyrostat::gap {

/// Logarithm of the modified Bessel function of order 0.
double log_bessel_i0(double x);

}  // namespace gyrostat::gap
