#include <gyrostat/generators/continuous_low_pass.hpp>

#include <cmath>
#include <numbers>

#include <gyrostat/core/numerics/dense.hpp>

namespace gyrostat {

LowPassSystem::LowPassSystem(double cycles_a_sample, std::size_t count, bool maximally_flat) {
  const auto order = static_cast<Eigen::Index>(count);
  const double w = 2.0 * std::numbers::pi * cycles_a_sample;
  A = Eigen::MatrixXd::Zero(order, order);
  b = Eigen::VectorXd::Zero(order);
  b[maximally_flat && order > 1 ? 1 : 0] = w;
  // One section after the other: y' = w (u - y), or y' = w v, v' = w (u - y - damping v).
  const auto take = [&](Eigen::Index into) {
    if (into > 1 || output > 0 || !poles.empty()) A(into, output) = w;
  };
  const Eigen::Index pairs = maximally_flat ? order / 2 : 0;
  for (Eigen::Index k = 0; k < pairs; ++k) {
    const double angle = std::numbers::pi * (2.0 * static_cast<double>(k) + 1.0) /
                         (2.0 * static_cast<double>(order));
    const Eigen::Index y = 2 * k, v = y + 1;
    take(v);
    A(y, v) = w;
    A(v, y) = -w;
    A(v, v) = -2.0 * std::sin(angle) * w;
    output = y;
    for (const double sign : {1.0, -1.0})
      poles.emplace_back(-w * std::sin(angle), sign * w * std::cos(angle));
  }
  for (Eigen::Index y = 2 * pairs; y < order; ++y) {
    take(y);
    A(y, y) = -w;
    output = y;
    poles.emplace_back(-w, 0.0);
  }
}

ContinuousLowPass::ContinuousLowPass(double cycles_a_sample, std::size_t poles,
                                     bool maximally_flat) {
  const LowPassSystem filter(cycles_a_sample, poles, maximally_flat);
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
