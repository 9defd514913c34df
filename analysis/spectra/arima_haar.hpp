#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {
namespace arima_haar {

/// What m steps do to x, with u_k = E[d_{k+1} | past] the state of the increments d:
///   d_{k+1} = u_k + delta1 a_{k+1},   u_{k+1} = phi u_k + (phi delta1 - delta2) a_{k+1}.
/// The rows are x_m - x_0, the sum of x_j - x_0 over j = 1..m, and u_m.
template <class T>
struct Block {
  T length;
  Vector<T, 3> gain;    ///< response to u_0
  Matrix<T, 3> spread;  ///< covariance from the innovations inside the block
};

template <class T>
Block<T> one_step(const Arima111<T>& p) {
  const Vector<T, 3> response(p.delta1_dps, p.delta1_dps, p.phi * p.delta1_dps - p.delta2_dps);
  return {T(1.0), Vector<T, 3>(T(1.0), T(1.0), p.phi), response * response.transpose()};
}

template <class T>
Block<T> operator+(const Block<T>& first, const Block<T>& second) {
  Matrix<T, 3> carry;
  carry << T(1.0), T(0.0), second.gain[0],    //
      second.length, T(1.0), second.gain[1],  //
      T(0.0), T(0.0), second.gain[2];
  return {first.length + second.length, carry * first.gain,
          carry * first.spread * carry.transpose() + second.spread};
}

/// Allan variance at the length of the block.
template <class T>
T allan_variance(const Arima111<T>& p, const Block<T>& block) {
  const T u_innovation = p.phi * p.delta1_dps - p.delta2_dps;
  const T u_variance = u_innovation * u_innovation / (T(1.0) - p.phi * p.phi);
  const Vector<T, 3> haar(block.length, T(-1.0), block.gain[1]);
  const T from_u = haar.dot(block.gain);
  const T difference =
      haar.dot(block.spread * haar) + block.spread(1, 1) + from_u * from_u * u_variance;
  const T r = p.measurement_noise_std_dps * p.measurement_noise_std_dps;
  return difference / (T(2.0) * block.length * block.length) + r / block.length;
}

}  // namespace arima_haar

/// Allan variance, dps^2, of z = x + v at clusters of `cluster` >= 1 samples: half the mean square
/// of the difference of neighbouring cluster means. Exact for |phi| < 1, by doubling blocks in
/// O(log cluster). Nothing is lost near phi = 0 or |phi| = 1, where the closed form by geometric
/// sums cancels as (1 - phi)^-4; with delta2 = delta1, x being stationary, the relative error is of
/// the order of 1e-16 cluster^2.
template <class T>
T arima_allan_variance(const Arima111<T>& p, std::size_t cluster) {
  const auto step = arima_haar::one_step(p);
  auto block = step;
  for (std::size_t bit = std::bit_floor(cluster) >> 1U; bit != 0; bit >>= 1U) {
    block = block + block;
    if ((cluster & bit) != 0) block = block + step;
  }
  return arima_haar::allan_variance(p, block);
}

/// The same at the clusters 1, 2, 4, ... 2^(scales - 1).
template <class T>
Vector<T, Eigen::Dynamic> dyadic_allan_variances(const Arima111<T>& p, Eigen::Index scales) {
  Vector<T, Eigen::Dynamic> variances(scales);
  auto block = arima_haar::one_step(p);
  for (T& variance : variances) {
    variance = arima_haar::allan_variance(p, block);
    block = block + block;
  }
  return variances;
}

/// Covariance of the logarithms of the overlapping Allan variances of `samples` values of z at the
/// clusters 1, 2, 4, ... 2^(scales - 1), 2^scales <= samples. With G_j the power gain of the Haar
/// filter and S the (pseudo-)spectrum of z, cov(nu_i, nu_j) = 2 / sqrt(M_i M_j) * mean over
/// frequency of G_i G_j S^2, M_j = samples - 2^(j+1) + 1 (Serroukh, Walden & Percival, JASA 2000),
/// and var log nu = v + v^2 / 2 for var nu = v nu^2.
inline Eigen::MatrixXd log_allan_covariance(const Arima111<double>& p, std::size_t samples,
                                            Eigen::Index scales) {
  const double delta1 = p.delta1_dps, delta2 = p.delta2_dps;
  const double r = p.measurement_noise_std_dps * p.measurement_noise_std_dps;
  const Eigen::Index points = Eigen::Index{4} << scales;
  Eigen::VectorXd power(scales);
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(scales);
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(scales, scales);
  for (Eigen::Index k = 0; k < points; ++k) {
    const double omega =
        std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(points);
    double s = std::pow(std::sin(0.5 * omega), 2);
    const double step = 4.0 * s;  // |1 - B|^2; and |a - b B|^2 = (a - b)^2 + a b |1 - B|^2
    const double increments = (std::pow(delta1 - delta2, 2) + delta1 * delta2 * step) /
                              (std::pow(1.0 - p.phi, 2) + p.phi * step);
    const double spectrum = increments / step + r;
    for (Eigen::Index j = 0; j < scales; ++j) {
      power[j] = std::ldexp(8.0 * s * s / step, -2 * static_cast<int>(j)) * spectrum;
      s = 4.0 * s * (1.0 - s);  // sin^2 of the doubled angle
    }
    variance += power;
    product += power * power.transpose();
  }
  Eigen::VectorXd scale(scales);
  for (Eigen::Index j = 0; j < scales; ++j) {
    const auto windows = static_cast<double>(samples + 1 - (std::size_t{2} << j));
    const double v =
        2.0 * static_cast<double>(points) * product(j, j) / (windows * variance[j] * variance[j]);
    scale[j] = std::sqrt((v + 0.5 * v * v) / product(j, j));
  }
  return scale.asDiagonal() * product * scale.asDiagonal();
}

}  // namespace gyrostat
