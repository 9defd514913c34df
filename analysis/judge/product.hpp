#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gyrostat/core/numerics/lanes.hpp>

namespace gyrostat::judge {

/// The sum of logarithms as the logarithm of a product, whose exponent is taken out where it grows:
/// a multiplication each, and half a unit in the last place of one, instead of a logarithm.
template <class T>
class Product {
 public:
  void multiply(const T& factor) {
    const T next = mantissa_ * factor;
    if (all(next >= T(small) && next <= T(large)))
      mantissa_ = next;
    else
      rescale(next, factor);
  }

  double logarithm(int lane) const {
    return std::log(Lanes<T>::at(mantissa_, lane)) + exponent_[lane] * std::numbers::ln2 +
           logarithms_[lane];
  }

 private:
  static constexpr double small = 0x1p-256, large = 0x1p256;

  void rescale(const T& next, const T& factor) {
    if (!all(next > T(0x1p-1000) && next < T(0x1p1000))) return rescale_one_by_one(next, factor);
    double values[Lanes<T>::count];
    Lanes<T>::store(next, values);
    for (int l = 0; l < Lanes<T>::count; ++l) {  // std::frexp of a normal number, without a branch
      constexpr std::uint64_t fraction = (std::uint64_t{1} << 52U) - 1;
      constexpr auto half = std::bit_cast<std::uint64_t>(0.5);
      constexpr auto units = std::bit_cast<std::uint64_t>(0x1p52);
      const auto bits = std::bit_cast<std::uint64_t>(values[l]);
      const double exponent = std::bit_cast<double>(bits >> 52U | units) - (0x1p52 + 1022.0);
      const bool keeps = values[l] >= small && values[l] <= large;
      exponent_[l] += keeps ? 0.0 : exponent;
      values[l] = keeps ? values[l] : std::bit_cast<double>((bits & fraction) | half);
    }
    mantissa_ = Lanes<T>::load(values);
  }

  void rescale_one_by_one(const T& next, const T& factor) {
    double values[Lanes<T>::count];
    Lanes<T>::store(next, values);
    for (int l = 0; l < Lanes<T>::count; ++l) {
      if (values[l] >= small && values[l] <= large) continue;
      if (values[l] > 0x1p-1000 && values[l] < 0x1p1000) {
        int exponent = 0;
        values[l] = std::frexp(values[l], &exponent);
        exponent_[l] += exponent;
      } else {  // a factor that no product holds
        values[l] = Lanes<T>::at(mantissa_, l);
        logarithms_[l] += std::log(Lanes<T>::at(factor, l));
      }
    }
    mantissa_ = Lanes<T>::load(values);
  }

  T mantissa_{1.0};
  double exponent_[Lanes<T>::count] = {}, logarithms_[Lanes<T>::count] = {};
};

}  // namespace gyrostat::judge
