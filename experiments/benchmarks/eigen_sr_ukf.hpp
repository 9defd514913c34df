#pragma once

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <gyrostat/core/models/nl_unscented.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// The yardstick: the SR-UKF (and SR-RSUKF) on model NL as one would write it with Eigen's
/// fixed-size matrices and decompositions, point by point as in van der Merwe and Wan (2001,
/// algorithm 3.1), all seven states, without any use of the model's structure.
class EigenSrUkf {
 public:
  using State = Eigen::Matrix<double, 7, 1>;
  using Square = Eigen::Matrix<double, 7, 7>;
  using Points = Eigen::Matrix<double, 7, 15>;

  explicit EigenSrUkf(const NlParameters<double>& p)
      : noise_std_(p.measurement_noise_std_dps),
        lambda_(p.alpha * p.alpha * (7 + p.kappa) - 7),
        w0m_(lambda_ / (7 + lambda_)),
        w0c_(w0m_ + 1 - p.alpha * p.alpha + p.beta),
        wi_(0.5 / (7 + lambda_)) {
    x_ << p.initial_x_dps, p.initial_x_previous_dps, p.phi, p.delta1_dps, p.delta2_dps, 0, 0;
    State std;
    std << p.initial_x_std_dps, p.initial_x_previous_std_dps, p.initial_phi_std,
        p.initial_delta1_std_dps, p.initial_delta2_std_dps, 1, 1;
    S_ = std.asDiagonal();
  }

  double step(double z, const State* twice_mu = nullptr) {
    Points chi = points();
    for (int i = 0; i < 15; ++i) chi.col(i) = transition(chi.col(i));
    x_ = w0m_ * chi.col(0) + wi_ * chi.rightCols<14>().rowwise().sum();
    S_ = root(chi.rightCols<14>().colwise() - x_, chi.col(0) - x_);

    if (twice_mu != nullptr) {
      Square information = (S_ * S_.transpose()).inverse();
      information.diagonal() -= *twice_mu;
      S_ = information.inverse().eval().llt().matrixL();
    }

    chi = points();
    const double predicted = w0m_ * chi(0, 0) + wi_ * chi.row(0).tail<14>().sum();
    const auto deviations = (chi.row(0).array() - predicted).eval();
    double variance = noise_std_ * noise_std_ + w0c_ * deviations(0) * deviations(0);
    State cross = w0c_ * deviations(0) * (chi.col(0) - x_);
    for (int i = 1; i < 15; ++i) {
      variance += wi_ * deviations(i) * deviations(i);
      cross += wi_ * deviations(i) * (chi.col(i) - x_);
    }
    const State gain = cross / variance;
    x_ += gain * (z - predicted);
    downdate(gain * std::sqrt(variance));

    x_.tail<2>().setZero();
    S_.bottomRows<2>().setZero();
    S_(5, 5) = S_(6, 6) = 1.0;
    return x_(0);
  }

 private:
  static State transition(const State& s) {
    State next = s;
    next(0) = (1 + s(2)) * s(0) - s(2) * s(1) + s(3) * s(5) - s(4) * s(6);
    next(1) = s(0);
    return next;
  }

  Points points() const {
    Points chi;
    chi.col(0) = x_;
    const Square spread = std::sqrt(7 + lambda_) * S_;
    chi.middleCols<7>(1) = spread.colwise() + x_;
    chi.rightCols<7>() = (-spread).colwise() + x_;
    return chi;
  }

  Square root(const Eigen::Matrix<double, 7, 14>& deviations, const State& centre) const {
    const Eigen::HouseholderQR<Eigen::Matrix<double, 14, 7>> qr(std::sqrt(wi_) *
                                                                deviations.transpose());
    Eigen::LLT<Square> llt;
    const Square upper = qr.matrixQR().topRows<7>().triangularView<Eigen::Upper>();
    const Square L = upper.transpose();
    llt.compute(L * L.transpose());
    llt.rankUpdate(centre, w0c_);
    return llt.matrixL();
  }

  void downdate(const State& u) {
    Eigen::LLT<Square> llt(S_ * S_.transpose());
    llt.rankUpdate(u, -1.0);
    S_ = llt.matrixL();
  }

  double noise_std_, lambda_, w0m_, w0c_, wi_;
  State x_;
  Square S_;
};

}  // namespace gyrostat
