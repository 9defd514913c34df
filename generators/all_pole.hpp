#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace gyrostat {

/// 1 / A(z), A of the given reflection coefficients, each within -1 and 1: what colours white noise
/// as an autoregression of that order does (the lattice: Haykin, "Adaptive Filter Theory", 4th ed.,
/// 3.8). A coefficient of 0 from some order on leaves the order at that.
template <std::size_t Order>
class AllPole {
 public:
  explicit AllPole(const std::array<double, Order>& reflections) : reflections_(reflections) {}

  /// The next output; at rest before the first.
  double operator()(double white) {
    double forward = white;
    for (std::size_t m = Order; m-- > 0;) {
      forward -= reflections_[m] * backward_[m];
      if (m + 1 < Order) backward_[m + 1] = backward_[m] + reflections_[m] * forward;
    }
    backward_[0] = forward;
    return forward;
  }

  /// Variance of the output where the input is unit white noise.
  double variance() const {
    double variance = 1.0;
    for (const double k : reflections_) variance /= (1.0 - k) * (1.0 + k);
    return variance;
  }

  /// |1 / A|² at an angle, radians a sample.
  double gain(double angle) const {
    // Levinson's step up.
    std::array<double, Order + 1> a{1.0};
    for (std::size_t m = 1; m <= Order; ++m) {
      const auto before = a;
      for (std::size_t j = 1; j <= m; ++j) a[j] += reflections_[m - 1] * before[m - j];
    }
    std::complex<double> sum = 0.0;
    for (std::size_t j = 0; j <= Order; ++j)
      sum += a[j] * std::polar(1.0, -angle * static_cast<double>(j));
    return 1.0 / std::norm(sum);
  }

 private:
  std::array<double, Order> reflections_, backward_{};
};

}  // namespace gyrostat
