#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace gyrostat {

/// A low-pass filter of continuous time, x' = A x + b u with the output x[output], time in samples:
/// equal poles, each with its half power at the cutoff, or Butterworth's, or two poles of that
/// natural frequency.
struct LowPassSystem {
  LowPassSystem(double cycles_a_sample, std::size_t poles, bool maximally_flat);
  static LowPassSystem of_second_order(double cycles_a_sample, double damping_ratio);

  std::vector<std::complex<double>> poles;
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::Index output = 0;

 private:
  explicit LowPassSystem(Eigen::Index order);
  /// A pair of poles of the angular frequency, after what there is.
  void add_pair(double w, double damping_ratio);
};

/// The same of a rate that is a cubic from one sample to the next, over which the linear system of
/// the filter and the cubic's derivatives is integrated exactly (Van Loan, "Computing integrals
/// involving the matrix exponential", IEEE Trans. Automatic Control 23, 1978). It begins at rest.
class ContinuousLowPass {
 public:
  explicit ContinuousLowPass(const LowPassSystem& filter);

  /// The output at the end of an interval. Slopes of the input are by the sample.
  double operator()(double from, double to, double slope_from, double slope_to);

 private:
  Eigen::MatrixXd transition_;  ///< of the state
  Eigen::MatrixXd by_input_;    ///< of the state by an input's value and three derivatives
  Eigen::VectorXd state_, next_;
  Eigen::Index output_ = 0;  ///< of the state
};

}  // namespace gyrostat
