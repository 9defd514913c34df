#pragma once

namespace gyrostat::gap {

/// factor exp(exponent), where that alone would overflow.
struct Scaled {
  double factor, exponent;
};

/// The modified Bessel function of order 0 at x >= 0, within a relative error of 5e-7: beyond 7.75
/// by Abramowitz and Stegun, "Handbook of Mathematical Functions", 9.8.2.
Scaled bessel_i0(double x);

/// Its logarithm.
double log_bessel_i0(double x);

}  // namespace gyrostat::gap
