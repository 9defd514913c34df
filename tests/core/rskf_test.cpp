#include <gyrostat/core/filters/rskf.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/filters/sr_rsukf.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/core/arima_signal.hpp>

namespace gyrostat::rskf_test {
namespace {

using filters::Kf;
using filters::Rskf;
using filters::SrRsukf;
using Parameters = filters::RskfParameters<double>;

Parameters parameters(double mu_x, double mu_x_previous) {
  Parameters p;
  p.phi = 0.4;
  p.delta1_dps = 0.02;
  p.delta2_dps = 0.01;
  p.measurement_noise_std_dps = 0.02;
  p.initial_x_std_dps = 0.05;
  p.initial_x_previous_std_dps = 0.04;
  p.mu_x = mu_x;
  p.mu_x_previous = mu_x_previous;
  return p;
}

std::vector<double> signal(std::size_t samples) {
  return arima_signal({0.4, 0.02, 0.01, 0.02}, samples, 5);
}

TEST(InflateCovariance, IsTheInverseOfTheInformationLessTwiceTheRisk) {
  const NormalStream stream(1, 0, "inflate");
  for (std::uint64_t k = 0; k < 200; ++k) {
    Matrix<double, 3> A;
    for (int i = 0; i < 9; ++i) A(i) = stream.normal(9 * k + static_cast<std::uint64_t>(i));
    Matrix<double, 3> P = A * A.transpose() + 0.1 * Matrix<double, 3>::Identity();
    const Vector<double, 3> mu(0.02, 0.0, 0.03);
    const Matrix<double, 3> information = P.inverse() - Matrix<double, 3>((2.0 * mu).asDiagonal());
    const bool exists = information.selfadjointView<Eigen::Lower>().eigenvalues()(0) > 0.0;
    const Matrix<double, 3> before = P;
    ASSERT_EQ((inflate_covariance<double, 3>(P, mu)), exists);
    if (exists) {
      EXPECT_LT((P * information - Matrix<double, 3>::Identity()).norm(), 1e-9);
    } else {
      EXPECT_EQ(P, before);
    }
  }
}

TEST(Rskf, AtZeroRiskIsKfBitForBit) {
  auto z = signal(1000);
  z[30] = no_value;
  z[60] = 1e6;
  z[90] = std::numeric_limits<double>::infinity();
  Rskf<double> with(parameters(0.0, 0.0));
  Kf<double> without(parameters(0.0, 0.0));
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (const double value : z) {
    const auto a = step(with, value), b = step(without, value);
    EXPECT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
    EXPECT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
    EXPECT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
    EXPECT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
    EXPECT_EQ(a.status, b.status);
  }
}

TEST(Rskf, EqualsTheInformationFormByInverses) {
  using Square = Matrix<long double, 2>;
  const auto p = parameters(60.0, 40.0);
  Rskf<double> filter(p);
  const ModelL<long double> model(cast_parameters<long double>(p));
  auto [x, P] = ModelL<long double>::initial(cast_parameters<long double>(p));
  Square F, Q = Square::Zero();
  F << model.first.transpose(), 1.0L, 0.0L;
  Q(0, 0) = model.q;
  const Square twice_mu = 2.0L * Vector<long double, 2>(p.mu_x, p.mu_x_previous).asDiagonal();
  for (const double z : signal(500)) {
    x = (F * x).eval();
    P = (F * P * F.transpose() + Q).eval();
    P = (P.inverse() - twice_mu).inverse().eval();
    const long double S = P(0, 0) + model.R, innovation = z - x(0);
    const Vector<long double, 2> K = P.col(0) / S;
    x += K * innovation;
    P -= (S * K * K.transpose()).eval();
    const auto s = step(filter, z);
    ASSERT_EQ(s.status, Status::ok);
    EXPECT_NEAR(s.estimate_dps, static_cast<double>(x(0)), 1e-12);
    EXPECT_NEAR(s.innovation_variance / static_cast<double>(S), 1.0, 1e-12);
    EXPECT_NEAR(s.estimate_variance / static_cast<double>(P(0, 0)), 1.0, 1e-12);
  }
}

TEST(Rskf, IsSrRsukfWithKnownParameters) {
  auto z = signal(1000);
  for (const std::size_t k : {200u, 201u, 202u, 600u}) z[k] = no_value;
  for (const double mu : {10.0, 30.0, 600.0}) {
    const auto p = parameters(mu, 0.5 * mu);
    Rskf<double> linear(p);
    filters::SrRsukfParameters<double> q;
    static_cast<RandomErrorParameters<double>&>(q) = p;
    q.initial_phi_std = q.initial_delta1_std_dps = q.initial_delta2_std_dps = q.mu_phi = 0.0;
    q.mu_x = p.mu_x;
    q.mu_x_previous = p.mu_x_previous;
    SrRsukf<double> unscented(q);
    int breakdowns = 0;
    for (const double value : z) {
      const auto a = step(linear, value), b = step(unscented, value);
      EXPECT_EQ(a.status, b.status);
      breakdowns += a.status == Status::risk_breakdown;
      EXPECT_NEAR(a.estimate_dps, b.estimate_dps, 1e-9);
      EXPECT_NEAR(a.estimate_variance / b.estimate_variance, 1.0, 1e-9);
      if (!std::isnan(value)) {
        EXPECT_NEAR(a.innovation_variance / b.innovation_variance, 1.0, 1e-9);
      }
    }
    EXPECT_EQ(breakdowns > 0, mu == 600.0) << mu;
  }
}

TEST(Rskf, RiskRaisesTheGain) {
  double before = 0.0;
  for (const double mu : {0.0, 30.0, 100.0}) {
    Rskf<double> filter(parameters(mu, 0.0));
    Step<double> last;
    for (int k = 0; k < 300; ++k) last = step(filter, 0.0);
    const double gain = step(filter, 1.0).estimate_dps;
    EXPECT_GT(gain, before);
    before = gain;
  }
}

TEST(Rskf, WithoutMeasurementsBreaksDownAndStaysFinite) {
  Rskf<double> filter(parameters(20.0, 0.0));
  EXPECT_EQ(step(filter, no_value).status, Status::no_measurement);
  for (int k = 0; k < 100; ++k) step(filter, no_value);
  for (int k = 0; k < 20000; ++k) {
    const auto s = step(filter, no_value);
    ASSERT_EQ(s.status, Status::risk_breakdown);
    ASSERT_TRUE(std::isfinite(s.estimate_dps) && std::isfinite(s.estimate_variance));
  }
  const auto s = step(filter, 1.0);
  EXPECT_EQ(s.status, Status::risk_breakdown);
  EXPECT_NEAR(s.estimate_dps, 1.0, 0.01);
  step(filter, 1.0);
  EXPECT_EQ(step(filter, 1.0).status, Status::ok);
}

}  // namespace
}  // namespace gyrostat::rskf_test
