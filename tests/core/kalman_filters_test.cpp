#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/filters/kf_ma.hpp>
#include <gyrostat/core/filters/none.hpp>
#include <gyrostat/core/filters/oracle.hpp>
#include <gyrostat/core/filters/stf.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::kalman_filters_test {
namespace {

using filters::Kf;
using filters::KfMa;
using filters::Oracle;
using filters::Stf;
using Parameters = RandomErrorParameters<double>;

/// A random error with strong moving average and little measurement noise.
Parameters parameters(double phi = 0.5, double delta1 = 0.02, double delta2 = 0.015,
                      double noise = 0.01) {
  Parameters p;
  p.phi = phi;
  p.delta1_dps = delta1;
  p.delta2_dps = delta2;
  p.measurement_noise_std_dps = noise;
  p.initial_x_dps = 0.3;
  p.initial_x_previous_dps = 0.2;
  p.initial_x_std_dps = 0.05;
  p.initial_x_previous_std_dps = 0.04;
  return p;
}

/// x_1 ... x_n and z_1 ... z_n as functions of the 3 + 2n standard normals that drive the model:
/// the initial x and x_previous and a_0, then a_k and v_k of each step.
struct Path {
  std::vector<double> x, z;

  Path(const Parameters& p, const std::vector<double>& normals) {
    double now = p.initial_x_dps + p.initial_x_std_dps * normals[0];
    double before = p.initial_x_previous_dps + p.initial_x_previous_std_dps * normals[1];
    double a = normals[2];
    for (std::size_t i = 3; i < normals.size(); i += 2) {
      const double next =
          (1.0 + p.phi) * now - p.phi * before + p.delta1_dps * normals[i] - p.delta2_dps * a;
      before = now;
      now = next;
      a = normals[i];
      x.push_back(now);
      z.push_back(now + p.measurement_noise_std_dps * normals[i + 1]);
    }
  }
};

/// `steps` of the model under the noise of a trial.
Path run(const Parameters& p, std::size_t steps, std::uint32_t trial) {
  std::vector<double> normals(3 + 2 * steps);
  NormalStream(1, trial, "kalman_filters_test").fill(0, normals);
  return {p, normals};
}

template <class F>
Step<double> step(F& filter, double z) {
  return filter.step({.gyro_dps = z});
}

void expect_same_bits(const Step<double>& a, const Step<double>& b) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  EXPECT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
  EXPECT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
  EXPECT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
  EXPECT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
  EXPECT_EQ(a.status, b.status);
}

/// Covariance of the innovations of F over the model's own noise, each divided by the standard
/// deviation that the filter states, from the response to each driving normal: no sampling.
template <class F>
Eigen::MatrixXd normalised_innovation_covariance(const Parameters& p, int steps) {
  const std::size_t inputs = 3 + 2 * static_cast<std::size_t>(steps);
  const auto innovations = [&](const std::vector<double>& normals) {
    F filter(p);
    Eigen::VectorXd out(steps);
    const Path signal(p, normals);
    for (int k = 0; k < steps; ++k) {
      const auto s = step(filter, signal.z[static_cast<std::size_t>(k)]);
      out(k) = s.innovation_dps / std::sqrt(s.innovation_variance);
    }
    return out;
  };
  const Eigen::VectorXd rest = innovations(std::vector<double>(inputs, 0.0));
  Eigen::MatrixXd response(steps, static_cast<Eigen::Index>(inputs));
  for (std::size_t i = 0; i < inputs; ++i) {
    std::vector<double> impulse(inputs, 0.0);
    impulse[i] = 1.0;
    response.col(static_cast<Eigen::Index>(i)) = innovations(impulse) - rest;
  }
  return response * response.transpose();
}

struct NisStatistics {
  double mean_deviation;      ///< of the mean of the sums, in standard errors
  double variance_deviation;  ///< of their variance, in standard errors
  double correlation[3];      ///< of successive innovations at lags 1, 2, 3, in standard errors
};

/// The sum of nu^2 / S over a run of `steps` is chi-square with `steps` degrees of freedom K: mean
/// K, variance 2K, and a sample variance over n runs with standard error 2K sqrt((2 + 12/K) / n).
template <class F>
NisStatistics nis_statistics(const Parameters& p, int steps = 20, int runs = 4000) {
  const double K = steps, n = runs;
  double sum = 0.0, squares = 0.0;
  std::array<double, 3> products{};
  for (int trial = 0; trial < runs; ++trial) {
    F filter(p);
    std::vector<double> e;
    double nis = 0.0;
    for (const double z :
         run(p, static_cast<std::size_t>(steps), static_cast<std::uint32_t>(trial)).z) {
      const auto s = step(filter, z);
      e.push_back(s.innovation_dps / std::sqrt(s.innovation_variance));
      nis += e.back() * e.back();
    }
    sum += nis;
    squares += (nis - K) * (nis - K);
    for (std::size_t lag = 1; lag <= 3; ++lag)
      for (std::size_t i = lag; i < e.size(); ++i) products[lag - 1] += e[i] * e[i - lag];
  }
  NisStatistics result{(sum / n - K) / std::sqrt(2.0 * K / n),
                       (squares / n - 2.0 * K) / (2.0 * K * std::sqrt((2.0 + 12.0 / K) / n)),
                       {}};
  for (int lag = 1; lag <= 3; ++lag)
    result.correlation[lag - 1] =
        products[static_cast<std::size_t>(lag - 1)] / std::sqrt(n * (K - lag));
  return result;
}

// At 5 standard errors each of these five checks fails falsely at 6e-7.
void expect_consistent(const NisStatistics& nis) {
  EXPECT_LT(std::abs(nis.mean_deviation), 5.0);
  EXPECT_LT(std::abs(nis.variance_deviation), 5.0);
  for (const double correlation : nis.correlation) EXPECT_LT(std::abs(correlation), 5.0);
}

TEST(Kf, OnARandomWalkSettlesOnTheRiccatiSolution) {
  const double q = 0.03 * 0.03, r = 0.1 * 0.1;
  Kf<double> kf(parameters(0.0, 0.03, 0.0, 0.1));
  Step<double> last;
  for (int k = 0; k < 500; ++k) last = step(kf, 0.0);
  const double predicted = 0.5 * (q + std::sqrt(q * q + 4.0 * q * r));
  EXPECT_NEAR(last.innovation_variance, predicted + r, 1e-14);
  EXPECT_NEAR(last.estimate_variance, predicted * r / (predicted + r), 1e-14);
}

TEST(Kf, WithEqualVariancesARandomWalkHasTheGoldenGain) {
  Kf<double> kf(parameters(0.0, 0.1, 0.0, 0.1));
  for (int k = 0; k < 500; ++k) step(kf, 0.0);
  const double before = kf.state().mean(0);
  EXPECT_NEAR(step(kf, before + 1.0).estimate_dps - before, 0.5 * (std::sqrt(5.0) - 1.0), 1e-12);
}

TEST(Kf, InnovationsAreWhiteWithTheVarianceStatedWhereDelta2IsZero) {
  const auto C = normalised_innovation_covariance<Kf<double>>(parameters(0.5, 0.02, 0.0), 40);
  EXPECT_LT((C - Eigen::MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Kf, InnovationsAreNeitherWhiteNorOfTheVarianceStatedWhereDelta2IsNot) {
  const auto C = normalised_innovation_covariance<Kf<double>>(parameters(), 40);
  EXPECT_GT(std::abs(C(39, 39) - 1.0), 0.05);
  EXPECT_GT(std::abs(C(39, 38)), 0.05);
}

TEST(Kf, NisIsChiSquareWhereTheModelIsTrue) {
  expect_consistent(nis_statistics<Kf<double>>(parameters(0.5, 0.02, 0.0)));
}

TEST(Kf, NisIsNotChiSquareWhereDelta2IsNotZero) {
  const auto nis = nis_statistics<Kf<double>>(parameters());
  EXPECT_GT(std::abs(nis.mean_deviation), 10.0);
  EXPECT_GT(std::abs(nis.correlation[0]), 10.0);
}

TEST(Kf, AMissingSampleIsPredictedAndCounted) {
  const auto p = parameters();
  Kf<double> kf(p);
  step(kf, 0.25);
  const auto before = kf.state();
  const auto s = step(kf, no_value);
  EXPECT_EQ(s.status, Status::no_measurement);
  EXPECT_TRUE(std::isnan(s.innovation_dps));
  EXPECT_DOUBLE_EQ(s.estimate_dps, before.mean(0) + p.phi * (before.mean(0) - before.mean(1)));
  EXPECT_GT(s.estimate_variance, before.covariance(0, 0));
}

TEST(KfMa, InnovationsAreWhiteWithTheVarianceStated) {
  for (const double phi : {-0.6, 0.0, 0.9})
    for (const double delta2 : {-0.02, 0.0, 0.015, 0.05}) {
      const auto C =
          normalised_innovation_covariance<KfMa<double>>(parameters(phi, 0.02, delta2), 40);
      EXPECT_LT((C - Eigen::MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST(KfMa, NisIsChiSquareWhereTheModelIsTrue) {
  expect_consistent(nis_statistics<KfMa<double>>(parameters()));
}

// Of n independent runs the mean of error^2 / variance is 1 with standard error sqrt(2 / n); at 5
// of them the check fails falsely at 6e-7.
TEST(KfMa, StatesTheVarianceOfItsOwnError) {
  const auto p = parameters();
  constexpr int runs = 4000;
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < runs; ++trial) {
    KfMa<double> filter(p);
    const Path signal = run(p, 20, trial);
    Step<double> last;
    for (const double z : signal.z) last = step(filter, z);
    sum += std::pow(last.estimate_dps - signal.x.back(), 2) / last.estimate_variance;
  }
  EXPECT_NEAR(sum / runs, 1.0, 5.0 * std::sqrt(2.0 / runs));
}

/// E[x_n | z] and var[x_n | z] by conditioning the joint Gaussian of x_n and every present z.
std::pair<double, double> conditioned(const Parameters& p, const std::vector<double>& z) {
  const std::size_t inputs = 3 + 2 * z.size();
  const auto outputs = [&](const std::vector<double>& normals) {
    const Path signal(p, normals);
    std::vector<double> out = {signal.x.back()};
    for (std::size_t k = 0; k < z.size(); ++k)
      if (!std::isnan(z[k])) out.push_back(signal.z[k]);
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(out.data(), std::ssize(out)));
  };
  const Eigen::VectorXd mean = outputs(std::vector<double>(inputs, 0.0));
  Eigen::MatrixXd response(mean.size(), static_cast<Eigen::Index>(inputs));
  for (std::size_t i = 0; i < inputs; ++i) {
    std::vector<double> impulse(inputs, 0.0);
    impulse[i] = 1.0;
    response.col(static_cast<Eigen::Index>(i)) = outputs(impulse) - mean;
  }
  const Eigen::MatrixXd joint = response * response.transpose();
  Eigen::VectorXd observed(mean.size() - 1);
  Eigen::Index row = 0;
  for (const double v : z)
    if (!std::isnan(v)) observed(row++) = v;
  const auto rest = observed.size();
  const Eigen::VectorXd gain =
      joint.bottomRightCorner(rest, rest).llt().solve(joint.col(0).tail(rest));
  return {mean(0) + gain.dot(observed - mean.tail(rest)),
          joint(0, 0) - gain.dot(joint.col(0).tail(rest))};
}

TEST(KfMa, EqualsGaussianConditioningOnEveryPrefixOfAShortSeries) {
  const auto p = parameters(0.7);
  auto z = run(p, 25, 0).z;
  z[4] = z[11] = z[12] = no_value;
  KfMa<double> filter(p);
  for (std::size_t k = 1; k <= z.size(); ++k) {
    const auto s = step(filter, z[k - 1]);
    const auto [mean, variance] =
        conditioned(p, {z.begin(), z.begin() + static_cast<std::ptrdiff_t>(k)});
    EXPECT_NEAR(s.estimate_dps, mean, 1e-11);
    EXPECT_NEAR(s.estimate_variance, variance, 1e-13);
  }
}

TEST(KfMa, WithoutMovingAverageIsKf) {
  const auto p = parameters(0.5, 0.02, 0.0);
  KfMa<double> exact(p);
  Kf<double> kf(p);
  for (const double z : run(p, 200, 0).z) {
    const auto a = step(exact, z), b = step(kf, z);
    EXPECT_NEAR(a.estimate_dps, b.estimate_dps, 1e-12);
    EXPECT_NEAR(a.innovation_variance, b.innovation_variance, 1e-15);
  }
}

filters::StfParameters<double> stf_parameters(double adaptive, double factor) {
  filters::StfParameters<double> p;
  static_cast<Parameters&>(p) = parameters();
  p.adaptive = adaptive;
  p.fading_factor = factor;
  return p;
}

TEST(Stf, WithAFixedFactorOfOneIsKfBitForBit) {
  Stf<double> stf(stf_parameters(0.0, 1.0));
  Kf<double> kf(parameters());
  auto z = run(parameters(), 500, 0).z;
  z[20] = no_value;
  z[40] = 1e6;
  z[60] = std::numeric_limits<double>::infinity();
  for (const double value : z) expect_same_bits(step(stf, value), step(kf, value));
}

TEST(Stf, AFixedFactorInflatesThePredictedCovarianceByIt) {
  const auto p = stf_parameters(0.0, 2.5);
  Stf<double> stf(p);
  const ModelL<double> model(p);
  const auto P0 = ModelL<double>::initial(p).covariance;
  const double expected = 2.5 * model.first.dot(P0 * model.first) + model.q + model.R;
  EXPECT_DOUBLE_EQ(step(stf, 0.3).innovation_variance, expected);
}

TEST(Stf, FollowsAJumpFasterThanKf) {
  Stf<double> stf(stf_parameters(1.0, 1.0));
  Kf<double> kf(parameters());
  for (int k = 0; k < 200; ++k) step(stf, 0.0), step(kf, 0.0);
  EXPECT_GT(step(stf, 1.0).estimate_dps, step(kf, 1.0).estimate_dps);
}

TEST(Stf, GoesOnAfterASampleTooLargeToSquare) {
  Stf<double> stf(stf_parameters(1.0, 1.0));
  for (int k = 0; k < 100; ++k) step(stf, 0.3);
  EXPECT_EQ(name_of(step(stf, 1e200).status), "not_finite");
  for (int k = 0; k < 100; ++k) ASSERT_EQ(name_of(step(stf, 0.5).status), "ok");
  EXPECT_NEAR(stf.state().mean(0), 0.5, 0.01);
}

TEST(FadingFactor, FollowsZhouAndFrank) {
  FadingParameters<double> p;
  p.forgetting = 0.95;
  p.softening = 2.0;
  FadingFactor<double> fading(p);
  // V = 9, then (0.95 9 + 4) / 1.95; N = V - 0.5 - 2 1; factor = N / 0.25.
  EXPECT_DOUBLE_EQ(fading.next(9.0, 0.5, 1.0, 0.25), (9.0 - 0.5 - 2.0) / 0.25);
  EXPECT_DOUBLE_EQ(fading.next(4.0, 0.5, 1.0, 0.25), ((0.95 * 9.0 + 4.0) / 1.95 - 2.5) / 0.25);
}

TEST(FadingFactor, IsNeverBelowItsLeast) {
  FadingParameters<double> p;
  p.fading_factor = 1.5;
  FadingFactor<double> fading(p);
  EXPECT_EQ(fading.next(0.0, 1.0, 1.0, 1.0), 1.5);
  EXPECT_EQ(fading.next(1e9, 1.0, 1.0, 0.0), 1.5);
}

TEST(Oracle, IsKfMaOnWhatMotionAndDriftLeave) {
  const auto p = parameters();
  Oracle<double> oracle(p);
  KfMa<double> filter(p);
  double t = 0.0;
  for (const double z : run(p, 200, 0).z) {
    const double rate = 30.0 * std::sin(t), drift = 0.4 + 0.01 * t;
    const auto expected = step(filter, z + rate + drift - (rate + drift));
    const auto s = oracle.step(
        {.t_s = t, .gyro_dps = z + rate + drift, .true_rate_dps = rate, .true_drift_dps = drift});
    EXPECT_DOUBLE_EQ(s.estimate_dps, expected.estimate_dps + drift);
    EXPECT_DOUBLE_EQ(s.estimate_variance, expected.estimate_variance);
    t += 0.01;
  }
}

TEST(None, EstimatesNothing) {
  filters::None<double> none({});
  for (const double z : {0.0, 1.0, no_value}) EXPECT_EQ(step(none, z).estimate_dps, 0.0);
}

}  // namespace
}  // namespace gyrostat::kalman_filters_test
