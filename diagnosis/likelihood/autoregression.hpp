#pragma once

#include <algorithm>
#include <vector>

namespace gyrostat::gap {

/// Autoregressions of every order up to that of an autocovariance, by Levinson's recursion.
struct Autoregression {
  std::vector<double> reflections;   ///< of A(z) = 1 + a_1 / z + ..., an order each
  std::vector<double> errors;        ///< variance of the innovations, order 0 first
  std::vector<double> coefficients;  ///< a_1, ... of the highest order
};

inline Autoregression autoregression(const std::vector<double>& autocovariance) {
  constexpr double least = 1e-6;  // what a reflection leaves of the error, at least
  Autoregression found{.reflections = {}, .errors = {autocovariance.at(0)}, .coefficients = {}};
  auto& a = found.coefficients;
  for (std::size_t m = 1; m < autocovariance.size(); ++m) {
    double k = autocovariance[m];
    for (std::size_t j = 0; j + 1 < m; ++j) k += a[j] * autocovariance[m - 1 - j];
    k /= -found.errors.back();
    const auto before = a;
    a.push_back(k);
    for (std::size_t j = 0; j + 1 < m; ++j) a[j] = before[j] + k * before[m - 2 - j];
    found.reflections.push_back(k);
    found.errors.push_back(found.errors.back() * std::max(least, 1.0 - k * k));
  }
  return found;
}

}  // namespace gyrostat::gap
