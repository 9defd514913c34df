#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace gyrostat {

/// A double that counts the operations made on it: additions, subtractions, multiplications,
/// divisions and square roots, one each.
struct Counted {
  double value = 0.0;
  static inline std::uint64_t operations = 0;

  Counted() = default;
  Counted(double v) : value(v) {}  // NOLINT

  static Counted made(double v) {
    ++operations;
    return v;
  }
  friend Counted operator+(Counted a, Counted b) { return made(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return made(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return made(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return made(a.value / b.value); }
  friend Counted operator-(Counted a) { return -a.value; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  Counted& operator/=(Counted b) { return *this = *this / b; }
  friend auto operator<=>(Counted a, Counted b) { return a.value <=> b.value; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend Counted sqrt(Counted a) { return made(std::sqrt(a.value)); }
  friend bool isnan(Counted a) { return std::isnan(a.value); }
  friend bool isfinite(Counted a) { return std::isfinite(a.value); }
};

}  // namespace gyrostat

template <>
struct Eigen::NumTraits<gyrostat::Counted> : Eigen::NumTraits<double> {
  using Real = gyrostat::Counted;
  using NonInteger = Real;
  using Nested = Real;
  enum { RequireInitialization = 0 };
};
