#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <gyrostat/core/numerics/dense.hpp>

namespace gyrostat::gap {

/// How much likelier, as a logarithm, white values become by what regressors explain of them.
class Explained {
 public:
  explicit Explained(std::size_t columns)
      : products_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(columns),
                                        static_cast<Eigen::Index>(columns))),
        with_values_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns))) {}

  void add(const Eigen::VectorXd& row, double value) {
    products_.selfadjointView<Eigen::Lower>().rankUpdate(row);
    with_values_ += value * row;
    squares_ += value * value;
    count_ += 1.0;
  }

  /// Beyond what chance gives, where `share` of the values are independent; 0 of too few.
  double log_gain(double share = 1.0) const {
    const auto columns = static_cast<double>(with_values_.size());
    if (count_ < 10.0 * columns) return 0.0;
    Eigen::MatrixXd normal = products_.selfadjointView<Eigen::Lower>();
    // A motion of few frequencies has regressors that are alike.
    normal.diagonal() += 1e-9 * normal.diagonal();
    const double explained = with_values_.dot(solve_symmetric(normal, with_values_));
    const double part = std::clamp(explained / std::max(squares_, 1e-300), 0.0, 1.0 - 1e-12);
    return -0.5 * share * count_ * std::log1p(-part) - 0.5 * columns;
  }

 private:
  Eigen::MatrixXd products_;
  Eigen::VectorXd with_values_;
  double squares_ = 0.0, count_ = 0.0;
};

}  // namespace gyrostat::gap
