#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace gyrostat {

/// First-order and total indices of a function of uniform parameters.
struct TrueIndices {
  std::vector<double> first_order, total;
};

/// sin x1 + 7 sin^2 x2 + x3^4 sin(x1) / 10 on [-pi, pi]^3, from the unit cube (Ishigami and Homma,
/// ISUMA 1990).
inline double ishigami(std::span<const double> u) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
  return std::sin(x(0)) * (1.0 + 0.1 * std::pow(x(2), 4)) + 7.0 * std::pow(std::sin(x(1)), 2);
}

inline TrueIndices ishigami_indices() {
  const double pi4 = std::pow(std::numbers::pi, 4), pi8 = pi4 * pi4;
  const double v1 = 0.5 * std::pow(1.0 + 0.1 * pi4 / 5.0, 2), v2 = 49.0 / 8.0;
  const double v13 = 0.01 * pi8 * 8.0 / 225.0, v = v1 + v2 + v13;
  return {{v1 / v, v2 / v, 0.0}, {(v1 + v13) / v, v2 / v, v13 / v}};
}

/// The product of (|4 u_i - 2| + a_i) / (1 + a_i) (Sobol', Math. Model. Comput. Exp. 1, 1993).
inline double sobol_g(std::span<const double> u, std::span<const double> a) {
  double product = 1.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    product *= (std::abs(4.0 * u[i] - 2.0) + a[i]) / (1.0 + a[i]);
  return product;
}

inline TrueIndices sobol_g_indices(std::span<const double> a) {
  const auto part = [&](std::size_t i) { return 1.0 / (3.0 * (1.0 + a[i]) * (1.0 + a[i])); };
  double all = 1.0;
  for (std::size_t i = 0; i < a.size(); ++i) all *= 1.0 + part(i);
  TrueIndices indices;
  for (std::size_t i = 0; i < a.size(); ++i) {
    indices.first_order.push_back(part(i) / (all - 1.0));
    indices.total.push_back(part(i) * all / (1.0 + part(i)) / (all - 1.0));
  }
  return indices;
}

}  // namespace gyrostat
