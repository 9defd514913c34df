#pragma once

#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// A value with its gradient along N inputs: forward-mode differentiation (Griewank and Walther
/// 2008, sec. 3.1), as far as a Kalman filter's recursion needs it.
template <class T, int N>
struct Dual {
  T value{0.0};
  Vector<T, N> gradient = Vector<T, N>::Zero();

  Dual() = default;
  Dual(const T& constant) : value(constant) {}  // NOLINT
  Dual(const T& v, const Vector<T, N>& g) : value(v), gradient(g) {}

  /// f(a) from its value and its derivative there.
  friend Dual operator*(const T& a, const Dual& b) { return {a * b.value, a * b.gradient}; }
  static Dual chain(const Dual& a, const T& f, const T& slope) { return {f, slope * a.gradient}; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.gradient}; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.gradient + b.gradient};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.gradient - b.gradient};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T ratio = a.value / b.value;
    return {ratio, (a.gradient - ratio * b.gradient) / b.value};
  }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
};

template <class T, int N>
Dual<T, N> exp(const Dual<T, N>& a) {
  using std::exp;
  const T f = exp(a.value);
  return Dual<T, N>::chain(a, f, f);
}

template <class T, int N>
Dual<T, N> tanh(const Dual<T, N>& a) {
  using std::tanh;
  const T f = tanh(a.value);
  return Dual<T, N>::chain(a, f, T(1.0) - f * f);
}

template <class T, int N>
bool isfinite(const Dual<T, N>& a) {
  using std::isfinite;
  for (int i = 0; i < N; ++i)
    if (!isfinite(a.gradient(i))) return false;
  return isfinite(a.value);
}

}  // namespace gyrostat
