#pragma once

#include <functional>
#include <vector>

#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// A parameter of a scenario on the scale that a fit moves it on.
struct Dial {
  std::function<double(const Scenario&)> get;
  std::function<void(Scenario&, double)> set;
  double furthest = 1.0;  ///< in one step of a fit
};

/// On a logarithmic scale, from `low` to `high`.
Dial logarithmic(const std::function<double&(Scenario&)>& value, double low, double high);
/// In multiples of `unit`.
Dial linear(const std::function<double&(Scenario&)>& value, double unit);

/// The scenario with every dial moved, each by its own.
Scenario moved(Scenario scenario, const std::vector<Dial>& dials, const Eigen::VectorXd& by);

}  // namespace gyrostat::gap
