#include <gyrostat/generators/continuous_low_pass.hpp>

#include <cmath>
#include <numbers>

#include <gyrostat/core/numerics/dense.hpp>

namespace gyrostat {

LowPassSystem::LowPassSystem(Eigen::Index order)
    : A(Eigen::MatrixXd::Zero(order, order)), b(Eigen::VectorXd::Zero(order)) {}

// One section after the other: y' = w v, v' = w (u - y - 2 damping v), or y' = w (u - y).
void LowPassSystem::add_pair(double w, double damping_ratio) {
  const auto y = static_cast<Eigen::Index>(poles.size()), v = y + 1;
  if (poles.empty())
    b[v] = w;
  else
    A(v, output) = w;
  A(y, v) = w;
  A(v, y) = -w;
  A(v, v) = -2.0 * damping_ratio * w;
  output = y;
  const auto apart = std::sqrt(std::complex<double>(damping_ratio * damping_ratio - 1.0));
  for (const double sign : {1.0, -1.0}) poles.push_back(w * (sign * apart - damping_ratio));
}

LowPassSystem::LowPassSystem(double cycles_a_sample, std::size_t count, bool maximally_flat)
    : LowPassSystem(static_cast<Eigen::Index>(count)) {
  const double w = 2.0 * std::numbers::pi * cycles_a_sample;
  const std::size_t pairs = maximally_flat ? count / 2 : 0;
  for (std::size_t k = 0; k < pairs; ++k)
    add_pair(w, std::sin(std::numbers::pi * (2.0 * static_cast<double>(k) + 1.0) /
                         (2.0 * static_cast<double>(count))));
  while (poles.size() < count) {
    const auto y = static_cast<Eigen::Index>(poles.size());
    if (poles.empty())
      b[y] = w;
    else
      A(y, output) = w;
    A(y, y) = -w;
    output = y;
    poles.emplace_back(-w, 0.0);
  }
}

LowPassSystem LowPassSystem::of_second_order(double cycles_a_sample, double damping_ratio) {
  LowPassSystem system(Eigen::Index{2});
  system.add_pair(2.0 * std::numbers::pi * cycles_a_sample, damping_ratio);
  return system;
}

ContinuousLowPass::ContinuousLowPass(const LowPassSystem& filter) {
  constexpr Eigen::Index derivatives = 4;
  const Eigen::Index order = filter.A.rows();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(order + derivatives, order + derivatives);
  system.topLeftCorner(order, order) = filter.A;
  system.block(0, order, order, 1) = filter.b;
  for (Eigen::Index k = 0; k + 1 < derivatives; ++k) system(order + k, order + k + 1) = 1.0;
  const Eigen::MatrixXd over_interval = matrix_exponential(system);
  transition_ = over_interval.topLeftCorner(order, order);
  by_input_ = over_interval.topRightCorner(order, derivatives);
  state_ = next_ = Eigen::VectorXd::Zero(order);
  output_ = filter.output;
}

double ContinuousLowPass::operator()(double from, double to, double slope_from, double slope_to) {
  const double rise = to - from;
  const Eigen::Vector4d input{from, slope_from, 2.0 * (3.0 * rise - 2.0 * slope_from - slope_to),
                              6.0 * (slope_from + slope_to - 2.0 * rise)};
  next_.noalias() = transition_.lazyProduct(state_);
  next_.noalias() += by_input_.lazyProduct(input);
  state_.swap(next_);
  return state_[output_];
}

}  // namespace gyrostat
