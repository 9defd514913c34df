#pragma once

#include <cmath>
#include <limits>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::judge {

/// Moments of errors that come by once; NaN is left out. A stretch is centred on its own mean, and
/// stretches are merged by Chan, Golub and LeVeque (The American Statistician 37, 1983, eq. 1.5):
/// no large sums are subtracted from each other, so a standard deviation keeps its digits beside
/// whatever mean. RMSE^2 = variance + mean^2, of which nothing cancels either.
template <class T>
class Moments {
 public:
  /// `sum` is that of all `errors`: NaN in the lanes that miss some.
  void add(const T* errors, std::size_t samples, const T& sum) {
    if (any(is_missing(sum))) return add_present(errors, samples);
    const T n(static_cast<double>(samples)), mean = sum / n;
    T spread(0.0);
    for (std::size_t k = 0; k < samples; ++k) {
      const T from_mean = errors[k] - mean;
      spread += from_mean * from_mean;
    }
    merge(n, sum, mean, spread);
  }

  /// Two of them in one loop.
  static void add(Moments& a, const T* of_a, const T& sum_a, Moments& b, const T* of_b,
                  const T& sum_b, std::size_t samples) {
    if (any(is_missing(sum_a + sum_b))) {
      a.add(of_a, samples, sum_a);
      return b.add(of_b, samples, sum_b);
    }
    const T n(static_cast<double>(samples)), mean_a = sum_a / n, mean_b = sum_b / n;
    T spread_a(0.0), spread_b(0.0);
    for (std::size_t k = 0; k < samples; ++k) {
      const T from_a = of_a[k] - mean_a, from_b = of_b[k] - mean_b;
      spread_a += from_a * from_a;
      spread_b += from_b * from_b;
    }
    a.merge(n, sum_a, mean_a, spread_a);
    b.merge(n, sum_b, mean_b, spread_b);
  }

  ErrorMoments of_lane(int lane) const {
    const double n = Lanes<T>::at(count_, lane);
    if (n == 0.0) return {};
    const double mean = Lanes<T>::at(sum_, lane) / n;
    const double variance = Lanes<T>::at(spread_, lane) / n;
    const double square = variance + mean * mean;
    // Errors that are infinite have no variance, but an RMSE.
    return {static_cast<std::size_t>(n), mean, std::sqrt(variance),
            square != square ? std::numeric_limits<double>::infinity() : std::sqrt(square)};
  }

 private:
  void add_present(const T* errors, std::size_t samples) {
    T n(0.0), sum(0.0), spread(0.0);
    for (std::size_t k = 0; k < samples; ++k) {
      const auto missing = is_missing(errors[k]);
      n += select(missing, T(0.0), T(1.0));
      sum += select(missing, T(0.0), errors[k]);
    }
    const T mean = sum / at_least_one(n);
    for (std::size_t k = 0; k < samples; ++k) {
      const T from_mean = errors[k] - mean;
      spread += select(is_missing(errors[k]), T(0.0), from_mean * from_mean);
    }
    merge(n, sum, mean, spread);
  }

  void merge(const T& n, const T& sum, const T& mean, const T& spread) {
    const T apart = mean - sum_ / at_least_one(count_);
    spread_ += spread + apart * apart * (count_ * n / at_least_one(count_ + n));
    sum_ += sum;
    count_ += n;
  }

  static T at_least_one(const T& n) { return select(n > T(0.0), n, T(1.0)); }

  T count_{0.0}, sum_{0.0}, spread_{0.0};
};

}  // namespace gyrostat::judge
