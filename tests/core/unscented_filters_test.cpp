#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/filters/sr_rsukf.hpp>
#include <gyrostat/core/filters/sr_ukf.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/core/reference/dense_unscented.hpp>

namespace gyrostat::unscented_filters_test {
namespace {

using filters::Kf;
using filters::SrRsukf;
using filters::SrRsukfParameters;
using filters::SrUkf;

/// Model NL with every parameter doubted.
SrRsukfParameters<double> parameters() {
  SrRsukfParameters<double> p;
  p.phi = 0.4;
  p.delta1_dps = 0.02;
  p.delta2_dps = 0.01;
  p.measurement_noise_std_dps = 0.02;
  p.initial_phi_std = 0.2;
  p.initial_delta1_std_dps = 0.01;
  p.initial_delta2_std_dps = 0.005;
  p.mu_phi = 0.0;
  return p;
}

/// A signal of ARIMA(1,1,1) with phi = 0.6 in white noise.
std::vector<double> signal(std::size_t samples, double noise_std = 0.02) {
  const NormalStream a(3, 0, "a"), v(3, 0, "v");
  std::vector<double> z(samples);
  double x = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    difference = 0.6 * difference + 0.02 * a.normal(k + 1) - 0.01 * a.normal(k);
    x += difference;
    z[k] = x + noise_std * v.normal(k);
  }
  return z;
}

template <class F, class T = double>
Step<T> step(F& filter, T z) {
  Sample<T> sample;
  sample.gyro_dps = z;
  return filter.step(sample);
}

double variance_of_phi(const NlUnscented<double>& state) {
  return state.root().row(2).squaredNorm();
}

/// The unscented filter of the augmented model in covariance form, point by point as in the
/// textbook (Wan and van der Merwe 2000, table 7.3.2), with the risk update by inverses.
template <class T>
class DenseUkf {
 public:
  using State = Vector<T, 7>;
  using Square = Matrix<T, 7>;

  explicit DenseUkf(const SrRsukfParameters<double>& p)
      : lambda_(T(p.alpha) * T(p.alpha) * (7 + T(p.kappa)) - 7),
        centre_(lambda_ / (7 + lambda_) + 1 - T(p.alpha) * T(p.alpha) + T(p.beta)),
        R_(T(p.measurement_noise_std_dps) * T(p.measurement_noise_std_dps)),
        mu_(p.diagonal().cast<T>()) {
    x_ << T(p.initial_x_dps), T(p.initial_x_previous_dps), T(p.phi), T(p.delta1_dps),
        T(p.delta2_dps), T(0), T(0);
    State std;
    std << T(p.initial_x_std_dps), T(p.initial_x_previous_std_dps), T(p.initial_phi_std),
        T(p.initial_delta1_std_dps), T(p.initial_delta2_std_dps), T(1), T(1);
    P_ = std.cwiseAbs2().asDiagonal();
  }

  Step<T> step(T z) {
    predict();
    P_ = (P_.inverse() - Square((2 * mu_).asDiagonal())).inverse().eval();
    const Step<T> s = update(z);
    x_.template tail<2>().setZero();
    P_.template bottomRows<2>().setZero();
    P_.template rightCols<2>().setZero();
    P_.template bottomRightCorner<2, 2>().setIdentity();
    return s;
  }

 private:
  Matrix<T, 7, 15> points() const {
    const Square spread = std::sqrt(7 + lambda_) * Square(P_.llt().matrixL());
    Matrix<T, 7, 15> out;
    out.col(0) = x_;
    for (int i = 0; i < 7; ++i) {
      out.col(1 + i) = x_ + spread.col(i);
      out.col(8 + i) = x_ - spread.col(i);
    }
    return out;
  }
  T mean_weight(int i) const { return (i == 0 ? lambda_ : T(0.5)) / (7 + lambda_); }
  T covariance_weight(int i) const { return i == 0 ? centre_ : mean_weight(i); }

  void predict() {
    auto chi = points();
    for (int i = 0; i < 15; ++i) {
      const State s = chi.col(i);
      chi(0, i) = s(0) + s(2) * (s(0) - s(1)) + s(3) * s(5) - s(4) * s(6);
      chi(1, i) = s(0);
    }
    x_.setZero();
    for (int i = 0; i < 15; ++i) x_ += mean_weight(i) * chi.col(i);
    P_.setZero();
    for (int i = 0; i < 15; ++i)
      P_ += covariance_weight(i) * (chi.col(i) - x_) * (chi.col(i) - x_).transpose();
  }

  Step<T> update(T z) {
    const auto chi = points();
    T predicted = 0, variance = R_;
    State cross = State::Zero();
    for (int i = 0; i < 15; ++i) predicted += mean_weight(i) * chi(0, i);
    for (int i = 0; i < 15; ++i) {
      variance += covariance_weight(i) * (chi(0, i) - predicted) * (chi(0, i) - predicted);
      cross += covariance_weight(i) * (chi.col(i) - x_) * (chi(0, i) - predicted);
    }
    const State gain = cross / variance;
    x_ += gain * (z - predicted);
    P_ -= gain * variance * gain.transpose();
    return {.estimate_dps = x_(0),
            .estimate_variance = P_(0, 0),
            .innovation_dps = z - predicted,
            .innovation_variance = variance};
  }

  T lambda_, centre_, R_;
  State mu_, x_;
  Square P_;
};

/// Both forms over the signal; the largest difference of estimate and innovation in units of the
/// innovation's standard deviation, and of the variances in relative terms.
template <class F>
double distance_from_dense(const SrRsukfParameters<double>& p, std::size_t samples) {
  F filter(p);
  DenseUkf<long double> dense(p);
  double worst = 0.0;
  for (const double z : signal(samples)) {
    const auto a = step(filter, z);
    const auto b = dense.step(z);
    EXPECT_EQ(name_of(a.status), "ok");
    const long double unit = std::sqrt(b.innovation_variance);
    for (const long double e :
         {(a.estimate_dps - b.estimate_dps) / unit, (a.innovation_dps - b.innovation_dps) / unit,
          a.estimate_variance / b.estimate_variance - 1,
          a.innovation_variance / b.innovation_variance - 1})
      worst = std::max(worst, static_cast<double>(std::abs(e)));
  }
  return worst;
}

TEST(ModelNl, TheIncrementIsTheDifferenceOfTransitions) {
  const NormalStream stream(1, 0, "increment");
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Vector<double, 7> s, d;
    for (std::uint64_t i = 0; i < 7; ++i) {
      s(static_cast<int>(i)) = stream.normal(14 * k + i);
      d(static_cast<int>(i)) = stream.normal(14 * k + 7 + i);
    }
    const Vector<double, 7> difference = reference::DenseModelNl<double>::transition(s + d) -
                                         reference::DenseModelNl<double>::transition(s);
    EXPECT_LT((reference::DenseModelNl<double>::increment(s, d) - difference).norm(), 1e-13);
  }
}

TEST(SrUkf, EqualsADenseUnscentedFilter) {
  EXPECT_LT(distance_from_dense<SrUkf<double>>(parameters(), 500), 1e-9);
}

TEST(SrUkf, EqualsADenseUnscentedFilterForOtherSpreads) {
  auto p = parameters();
  for (const auto& [alpha, beta, kappa] :
       {std::array{0.5, 2.0, 0.0}, std::array{0.05, 2.0, 1.0}, std::array{1.0, 0.0, -4.0}}) {
    p.alpha = alpha;
    p.beta = beta;
    p.kappa = kappa;
    EXPECT_LT(distance_from_dense<SrUkf<double>>(p, 200), 1e-9) << alpha << ", " << kappa;
  }
}

TEST(SrRsukf, EqualsADenseRiskSensitiveFilterForAnyDiagonalRisk) {
  auto p = parameters();
  p.mu_x = 5.0;
  p.mu_x_previous = 3.0;
  p.mu_phi = 0.1;
  p.mu_delta1 = 30.0;
  p.mu_delta2 = 40.0;
  p.mu_a = 0.05;
  p.mu_a_previous = 0.03;
  EXPECT_LT(distance_from_dense<SrRsukf<double>>(p, 60), 1e-9);
}

TEST(SrRsukf, AtZeroRiskIsTheSrUkfBitForBit) {
  auto z = signal(1000);
  z[30] = no_value;
  z[60] = 1e5;
  z[90] = std::numeric_limits<double>::infinity();
  SrRsukf<double> with(parameters());
  SrUkf<double> without(parameters());
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (const double value : z) {
    const auto a = step(with, value), b = step(without, value);
    EXPECT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
    EXPECT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
    EXPECT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
    EXPECT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
    EXPECT_EQ(a.status, b.status);
  }
  EXPECT_EQ(with.state().mean(), without.state().mean());
  EXPECT_EQ(with.state().root(), without.state().root());
}

TEST(SrRsukf, RiskKeepsTheVarianceOfPhiAboveThatOfTheSrUkf) {
  auto p = parameters();
  SrUkf<double> plain(p);
  p.mu_phi = 0.02;
  SrRsukf<double> sensitive(p);
  for (const double z : signal(300)) {
    step(plain, z);
    step(sensitive, z);
    EXPECT_GT(variance_of_phi(sensitive.state()), variance_of_phi(plain.state()));
  }
}

TEST(SrUkf, WithKnownParametersIsKf) {
  for (const double alpha : {1e-3, 0.1, 1.0, 2.0})
    for (const double kappa : {-4.0, 0.0, 3.0}) {
      auto p = parameters();
      p.initial_phi_std = p.initial_delta1_std_dps = p.initial_delta2_std_dps = 0.0;
      p.alpha = alpha;
      p.kappa = kappa;
      SrUkf<double> unscented(p);
      Kf<double> kf(p);
      for (const double z : signal(500)) {
        const auto a = step(unscented, z), b = step(kf, z);
        EXPECT_EQ(name_of(a.status), "ok");
        EXPECT_NEAR(a.estimate_dps, b.estimate_dps, 1e-9) << alpha << ", " << kappa;
        EXPECT_NEAR(a.innovation_variance / b.innovation_variance, 1.0, 1e-9) << alpha;
        EXPECT_NEAR(a.estimate_variance / b.estimate_variance, 1.0, 1e-9) << alpha;
      }
    }
}

/// With x seen exactly, d_k = phi d_{k-1} + noise of variance delta1^2 + delta2^2 is a linear
/// regression on phi, whose posterior under the prior N(phi_0, std^2) is known.
TEST(SrUkf, WithoutMeasurementNoiseEstimatesPhiByBayesianRegression) {
  auto p = parameters();
  p.measurement_noise_std_dps = 0.0;
  p.initial_delta1_std_dps = p.initial_delta2_std_dps = 0.0;
  p.initial_x_std_dps = p.initial_x_previous_std_dps = 0.0;
  SrUkf<double> filter(p);
  const double noise = p.delta1_dps * p.delta1_dps + p.delta2_dps * p.delta2_dps;
  double information = 1.0 / (p.initial_phi_std * p.initial_phi_std), pull = p.phi * information;
  double before = 0.0, now = 0.0;
  for (const double z : signal(300, 0.0)) {
    information += (now - before) * (now - before) / noise;
    pull += (now - before) * (z - now) / noise;
    before = now;
    now = z;
    EXPECT_NEAR(step(filter, z).estimate_dps, z, 1e-15);
    EXPECT_NEAR(filter.state().mean()(2), pull / information, 1e-10);
    EXPECT_NEAR(variance_of_phi(filter.state()) * information, 1.0, 1e-9);
  }
}

/// Data of any kind: noise, a jump, a ramp, outliers, silence.
std::vector<double> anything() {
  auto z = signal(600);
  for (std::size_t k = 100; k < 200; ++k) z[k] += 5.0;
  for (std::size_t k = 200; k < 300; ++k) z[k] += 0.1 * static_cast<double>(k);
  for (std::size_t k = 300; k < 400; k += 7) z[k] = -50.0;
  for (std::size_t k = 400; k < 450; ++k) z[k] = no_value;
  for (std::size_t k = 450; k < 500; ++k) z[k] = 0.0;
  return z;
}

TEST(SrUkf, Delta1AndDelta2NeverMoveWhateverTheData) {
  const auto p = parameters();
  SrUkf<double> filter(p);
  for (const double z : anything()) {
    step(filter, z);
    EXPECT_NEAR(filter.state().mean()(3), p.delta1_dps, 1e-12 * p.initial_delta1_std_dps);
    EXPECT_NEAR(filter.state().mean()(4), p.delta2_dps, 1e-12 * p.initial_delta2_std_dps);
  }
}

TEST(SrUkf, TheVarianceOfPhiNeverGrowsAndDataMakeItSmall) {
  const auto p = parameters();
  SrUkf<double> filter(p);
  double before = p.initial_phi_std * p.initial_phi_std;
  for (const double z : anything()) {
    step(filter, z);
    const double now = variance_of_phi(filter.state());
    EXPECT_LE(now, before * (1.0 + 1e-12));
    before = now;
  }
  EXPECT_LT(before, 0.1 * p.initial_phi_std * p.initial_phi_std);
}

TEST(SrUkf, AMissingSampleIsPredictedAndCounted) {
  SrUkf<double> filter(parameters());
  const auto before = step(filter, 0.1);
  const auto s = step(filter, no_value);
  EXPECT_EQ(s.status, Status::no_measurement);
  EXPECT_TRUE(std::isnan(s.innovation_dps));
  EXPECT_GT(s.estimate_variance, before.estimate_variance);
}

/// P spans 1e12: x is known to 1000 dps at first, delta1 and delta2 to 1e-6 dps beside unit noise.
TEST(SrUkf, TheRootStaysDefiniteWhereTheCovarianceSpansTwelveDecades) {
  auto p = parameters();
  p.initial_x_std_dps = p.initial_x_previous_std_dps = 1000.0;
  p.initial_delta1_std_dps = p.initial_delta2_std_dps = 1e-6;
  SrUkf<double> filter(p);
  for (const double z : signal(3000)) {
    EXPECT_EQ(step(filter, z).status, Status::ok);
    for (int i = 0; i < 7; ++i) EXPECT_NE(filter.state().root()(i, i), 0.0);
  }
}

TEST(SrUkf, TheKernelOnLongDoubleAgreesWhereTheCovarianceSpansTwelveDecades) {
  auto p = parameters();
  p.initial_x_std_dps = p.initial_x_previous_std_dps = 1000.0;
  p.initial_delta1_std_dps = p.initial_delta2_std_dps = 1e-6;
  SrUkf<double> narrow(p);
  SrUkf<long double> wide(
      cast_parameters<long double>(static_cast<const NlParameters<double>&>(p)));
  for (const double z : signal(1000)) {
    const auto a = step(narrow, z);
    const auto b = step(wide, static_cast<long double>(z));
    EXPECT_NEAR(a.estimate_dps, static_cast<double>(b.estimate_dps), 1e-9);
    EXPECT_NEAR(a.estimate_variance / static_cast<double>(b.estimate_variance), 1.0, 1e-9);
  }
}

/// 1 / P_phi falls by 2 mu a step where nothing is learned: from 10 by 0.2, so that step 50 meets
/// P^-1 - 2 mu = 0 to within rounding, and step 51 at the latest cannot be made.
class UninformedRisk : public testing::Test {
 protected:
  UninformedRisk() {
    auto p = parameters();
    p.initial_phi_std = std::sqrt(0.1);
    p.mu_phi = 0.1;
    filter_ = std::make_unique<SrRsukf<double>>(p);
  }

  std::unique_ptr<SrRsukf<double>> filter_;
};

TEST_F(UninformedRisk, InformationOnPhiFallsByTwiceTheRiskUntilItBreaksDown) {
  int steps = 0;
  for (; steps < 49; ++steps) {
    ASSERT_EQ(step(*filter_, no_value).status, Status::no_measurement) << steps;
    EXPECT_NEAR(1.0 / variance_of_phi(filter_->state()), 10.0 - 0.2 * (steps + 1), 1e-9);
  }
  while (step(*filter_, no_value).status != Status::risk_breakdown && steps < 60) ++steps;
  EXPECT_TRUE(steps == 49 || steps == 50) << steps;
}

TEST_F(UninformedRisk, AfterTheBreakdownEveryStepReportsItAndStaysFinite) {
  for (int k = 0; k < 51; ++k) step(*filter_, no_value);
  for (int k = 0; k < 20000; ++k) {
    const auto s = step(*filter_, no_value);
    ASSERT_EQ(s.status, Status::risk_breakdown) << k;
    ASSERT_TRUE(std::isfinite(s.estimate_dps) && std::isfinite(s.estimate_variance)) << k;
    ASSERT_TRUE(filter_->state().is_finite());
  }
}

TEST_F(UninformedRisk, ABreakdownStillLetsTheMeasurementIn) {
  for (int k = 0; k < 60; ++k) step(*filter_, no_value);
  const auto s = step(*filter_, 1.0);
  EXPECT_EQ(s.status, Status::risk_breakdown);
  EXPECT_TRUE(std::isfinite(s.innovation_dps));
  EXPECT_NEAR(s.estimate_dps, 1.0, 0.01);
}

TEST_F(UninformedRisk, DataThatInformPutTheBreakdownOff) {
  for (const double z : signal(5000)) EXPECT_EQ(step(*filter_, z).status, Status::ok);
}

}  // namespace
}  // namespace gyrostat::unscented_filters_test
