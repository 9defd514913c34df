#include <gyrostat/generators/sampled_low_pass.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

#include <gyrostat/core/numerics/dense.hpp>

namespace gyrostat {
namespace {

/// Autocovariance at lags 0, 1, ... of the output while white noise of unit density drives it.
std::vector<double> autocovariance_of(const LowPassSystem& filter, std::size_t lags) {
  const Eigen::Index order = filter.A.rows();
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(2 * order, 2 * order);
  both.topLeftCorner(order, order) = -filter.A;
  both.topRightCorner(order, order) = filter.b * filter.b.transpose();
  both.bottomRightCorner(order, order) = filter.A.transpose();
  // Over a part of an interval in which no pole forgets much: -A grows as A decays.
  const int halvings = std::max(0, std::ilogb(filter.A.cwiseAbs().rowwise().sum().maxCoeff()) + 1);
  const Eigen::MatrixXd over = matrix_exponential(both * std::ldexp(1.0, -halvings));
  Eigen::MatrixXd transition = over.bottomRightCorner(order, order).transpose();
  Eigen::MatrixXd covariance = transition * over.topRightCorner(order, order), power = transition;
  // Sums of twice as many intervals at a time.
  for (int doubling = 0; doubling < 40; ++doubling) {
    covariance += (power * covariance * power.transpose()).eval();
    power = (power * power).eval();
    if (doubling < halvings) transition = power;
  }
  Eigen::VectorXd row = covariance.col(filter.output);
  std::vector<double> all;
  for (std::size_t lag = 0; lag < lags; ++lag) {
    all.push_back(row[filter.output]);
    row = (transition * row).eval();
  }
  return all;
}

/// 1, a1, a2, ... whose roots are those of the filter over an interval.
std::vector<double> autoregression_of(const LowPassSystem& filter) {
  std::vector<std::complex<double>> polynomial = {1.0};
  for (const auto& pole : filter.poles) {
    polynomial.emplace_back(0.0);
    for (std::size_t k = polynomial.size(); --k > 0;)
      polynomial[k] -= std::exp(pole) * polynomial[k - 1];
  }
  std::vector<double> a;
  for (const auto& value : polynomial) a.push_back(value.real());
  return a;
}

/// The invertible moving average with this autocovariance, by the innovations of ever more samples
/// (Brockwell and Davis, "Time Series: Theory and Methods", 2nd ed., 5.2).
std::vector<double> moving_average_of(const std::vector<double>& autocovariance) {
  const std::size_t order = autocovariance.size() - 1;
  constexpr std::size_t samples = 400;
  std::vector<std::vector<double>> shares;  // of the innovation so many samples before
  std::vector<double> variances;
  for (std::size_t n = 0; n < samples; ++n) {
    std::vector<double> share(order + 1, 0.0);
    double variance = autocovariance[0];
    for (std::size_t lag = std::min(n, order); lag > 0; --lag) {
      const std::size_t k = n - lag;
      double sum = autocovariance[lag];
      for (std::size_t further = lag + 1; further <= std::min(n, order); ++further)
        sum -= shares[k][further - lag] * share[further] * variances[n - further];
      share[lag] = sum / variances[k];
      variance -= share[lag] * share[lag] * variances[k];
    }
    share[0] = 1.0;
    shares.push_back(std::move(share));
    variances.push_back(variance);
  }
  auto b = shares.back();
  for (double& value : b) value *= std::sqrt(variances.back());
  return b;
}

}  // namespace

SampledLowPass::SampledLowPass(const LowPassSystem& filter) {
  const std::size_t poles = filter.poles.size();
  a_ = autoregression_of(filter);
  const auto r = autocovariance_of(filter, 2 * poles);
  std::vector<double> left(poles, 0.0);  // what the autoregression makes of it: no further lags
  for (std::size_t lag = 0; lag < poles; ++lag)
    for (std::size_t i = 0; i <= poles; ++i)
      for (std::size_t k = 0; k <= poles; ++k)
        left[lag] += a_[i] * a_[k] * r[lag + k > i ? lag + k - i : i - lag - k];
  b_ = moving_average_of(left);
  double above = 0.0, below = 0.0;
  for (const double b : b_) above += b;
  for (const double a : a_) below += a;
  for (double& b : b_) b *= below / above;
  a_.erase(a_.begin());
  inputs_.assign(b_.size(), 0.0);
  outputs_.assign(a_.size(), 0.0);
}

double SampledLowPass::operator()(double white) {
  const auto shift_in = [](std::vector<double>& values, double value) {
    for (std::size_t k = values.size(); --k > 0;) values[k] = values[k - 1];
    values[0] = value;
  };
  shift_in(inputs_, white);
  double out = 0.0;
  for (std::size_t k = 0; k < b_.size(); ++k) out += b_[k] * inputs_[k];
  for (std::size_t k = 0; k < a_.size(); ++k) out -= a_[k] * outputs_[k];
  shift_in(outputs_, out);
  return out;
}

namespace {

constexpr int folds = 3;

}  // namespace

FoldedGain::FoldedGain(double cutoff_cycles, std::size_t poles, bool maximally_flat)
    : cutoff_cycles_(cutoff_cycles), poles_(poles), maximally_flat_(maximally_flat) {
  // All further ones, by the integral from half a fold on.
  constexpr double first = folds + 0.5;
  const double power = 2.0 * static_cast<double>(poles);
  further_ = 2.0 * std::pow(cutoff_cycles, power) * std::pow(first, 1.0 - power) / (power - 1.0);
  at_rest_ = sum_at(0.0);
}

FoldedGain FoldedGain::of_second_order(double cutoff_cycles, double damping_ratio) {
  FoldedGain folded(cutoff_cycles, 2, false);
  folded.damping_ratio_ = damping_ratio;
  folded.at_rest_ = folded.sum_at(0.0);
  return folded;
}

double FoldedGain::sum_at(double cycles) const {
  double sum = further_;
  for (int fold = -folds; fold <= folds; ++fold) {
    const double x = (cycles + fold) / cutoff_cycles_;
    if (damping_ratio_ > 0.0) {
      sum += second_order_gain(x * x, damping_ratio_);
      continue;
    }
    const double base = maximally_flat_ ? x * x : 1.0 + x * x;
    double power = base;
    for (std::size_t k = 1; k < poles_; ++k) power *= base;
    sum += 1.0 / (maximally_flat_ ? 1.0 + power : power);
  }
  return sum;
}

}  // namespace gyrostat
