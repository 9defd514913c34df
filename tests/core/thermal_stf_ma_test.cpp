#include <gyrostat/core/filters/thermal_stf_ma.hpp>

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <gyrostat/core/filters/thermal_kf.hpp>
#include <gyrostat/core/filters/thermal_stf.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::thermal_stf_ma_test {
namespace {

using filters::KfRule;
using filters::StfMaRule;
using filters::ThermalKf;
using filters::ThermalStfMa;
using Parameters = CoefficientKalmanMaParameters<double>;

constexpr double interval_s = 10.0;

/// Constant coefficients, no fading; the compass noise makes 98 % of the variance of M.
Parameters parameters(double compass_noise_std_deg = 0.07, double white_std_dps = 0.0014) {
  Parameters p;
  p.a_dps_per_C = 0.002;
  p.b_dps_s_per_C = 0.1;
  p.c_dps = -0.05;
  p.initial_a_std_dps_per_C = 5e-4;
  p.initial_b_std_dps_s_per_C = 0.05;
  p.initial_c_std_dps = 0.02;
  p.process_a_std_dps_per_C = p.process_b_std_dps_s_per_C = p.process_c_std_dps = 0.0;
  p.update_interval_s = interval_s;
  p.compass_noise_std_deg = compass_noise_std_deg;
  p.bias_measurement_std_dps =
      std::hypot(white_std_dps, std::sqrt(2.0) * compass_noise_std_deg / interval_s);
  p.adaptive = 0.0;
  return p;
}

double white_variance(const Parameters& p) {
  const double n = p.compass_noise_std_deg / p.update_interval_s;
  return p.bias_measurement_std_dps * p.bias_measurement_std_dps - 2.0 * n * n;
}

/// A linear drift with coefficients from the prior, measured every interval at a temperature that
/// rises and falls.
struct Drift {
  Vector<double, 3> coefficients;
  std::vector<BiasEpoch<double>> epochs;

  Drift(const Parameters& p, std::size_t count, std::uint32_t trial) {
    const NormalStream x(9, trial, "coefficients"), n(9, trial, "compass"), w(9, trial, "white");
    coefficients = p.coefficients() + Vector<double, 3>(p.initial_a_std_dps_per_C * x.normal(0),
                                                        p.initial_b_std_dps_s_per_C * x.normal(1),
                                                        p.initial_c_std_dps * x.normal(2));
    const double noise = p.compass_noise_std_deg / interval_s, white = std::sqrt(white_variance(p));
    for (std::size_t k = 0; k < count; ++k) {
      const double t = 0.1 * static_cast<double>(k + 1);
      BiasEpoch<double> epoch{.regressors = {40.0 - 17.0 * std::cos(t), 0.17 * std::sin(t), 1.0}};
      epoch.bias_dps = epoch.regressors.dot(coefficients) -
                       noise * (n.normal(k + 1) - n.normal(k)) + white * w.normal(k);
      epochs.push_back(epoch);
    }
  }
};

/// Mean and covariance of the coefficients given every present M at once: M = H X + e with
/// cov(e) tridiagonal.
Gaussian<double, 3> conditioned(const Parameters& p, const std::vector<BiasEpoch<double>>& epochs) {
  std::vector<Eigen::Index> present;
  for (std::size_t k = 0; k < epochs.size(); ++k)
    if (epochs[k].is_valid()) present.push_back(static_cast<Eigen::Index>(k));
  const auto m = std::ssize(present);
  const double n = p.compass_noise_std_deg / interval_s;
  Eigen::MatrixXd H(m, 3), C = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd M(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto& epoch = epochs[static_cast<std::size_t>(present[static_cast<std::size_t>(i)])];
    for (Eigen::Index j = 0; j < 3; ++j) H(i, j) = epoch.regressors(j);
    M(i) = epoch.bias_dps;
    C(i, i) = white_variance(p) + 2.0 * n * n;
    if (i > 0 &&
        present[static_cast<std::size_t>(i)] - present[static_cast<std::size_t>(i - 1)] == 1)
      C(i, i - 1) = C(i - 1, i) = -n * n;
  }
  const Eigen::MatrixXd P = p.initial_covariance(), HP = H * P;
  C += HP * H.transpose();
  const Eigen::VectorXd prior = p.coefficients(), innovation = M - H * prior;
  const Eigen::MatrixXd solved = Eigen::LDLT<Eigen::MatrixXd>(C).solve(HP);
  const Eigen::VectorXd mean = prior + solved.transpose() * innovation;
  const Eigen::MatrixXd covariance = P - solved.transpose() * HP;
  return {mean, covariance};
}

TEST(ThermalStfMa, EqualsGaussianConditioningOnEveryPrefix) {
  const auto p = parameters();
  auto epochs = Drift(p, 40, 0).epochs;
  for (const std::size_t k : {3u, 10u, 11u, 20u, 22u}) epochs[k].bias_dps = no_value;
  StfMaRule<double> rule(p);
  for (std::size_t k = 1; k <= epochs.size(); ++k) {
    EXPECT_EQ(rule.update(epochs[k - 1]).has_value(), epochs[k - 1].is_valid());
    const auto expected =
        conditioned(p, {epochs.begin(), epochs.begin() + static_cast<std::ptrdiff_t>(k)});
    const auto [mean, covariance] = rule.coefficients();
    const Vector<double, 3> std = p.initial_covariance().diagonal().cwiseSqrt();
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(mean(i), expected.mean(i), 1e-10 * std(i));
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(covariance(i, j), expected.covariance(i, j), 1e-10 * std(i) * std(j));
    }
  }
}

struct Nees {
  double coefficients = 0.0;  ///< per dimension
  double bias = 0.0;
  double rmse = 0.0;  ///< of the bias
};

/// Over trials, after `count` measurements: mean of the normalised squared errors. Of `trials`
/// independent ones the standard errors are sqrt(2 / (3 trials)) and sqrt(2 / trials).
template <class Rule>
Nees nees(const Rule& fresh, const Parameters& p, std::size_t count, int trials) {
  Nees result;
  for (std::uint32_t trial = 0; trial < static_cast<std::uint32_t>(trials); ++trial) {
    const Drift drift(p, count, trial);
    Rule rule = fresh;
    for (const auto& epoch : drift.epochs) rule.update(epoch);
    const auto [mean, covariance] = rule.coefficients();
    const Vector<double, 3> error = mean - drift.coefficients;
    const auto& h = drift.epochs.back().regressors;
    const Eigen::VectorXd e = error, solved = Eigen::LDLT<Eigen::MatrixXd>(covariance).solve(e);
    result.coefficients += e.dot(solved) / 3.0 / trials;
    const double bias_error = h.dot(error);
    result.bias += bias_error * bias_error / h.dot(covariance * h) / trials;
    result.rmse += bias_error * bias_error / trials;
  }
  result.rmse = std::sqrt(result.rmse);
  return result;
}

KfRule<double> kf_rule(const Parameters& p) {
  CoefficientKalmanParameters<double> q;
  static_cast<ThermalParameters<double>&>(q) = p;
  static_cast<CoefficientWalk<double>&>(q) = p;
  return KfRule<double>(q);
}

Nees mine(const Parameters& p, std::size_t count, int trials) {
  return nees(StfMaRule<double>(p), p, count, trials);
}

Nees of_kf(const Parameters& p, std::size_t count, int trials) {
  return nees(kf_rule(p), p, count, trials);
}

// At 5 standard errors each of these checks fails falsely at 6e-7.
TEST(ThermalStfMa, StatesTheVarianceOfItsErrorWhereTheModelIsTrue) {
  constexpr int trials = 1000;
  for (const std::size_t count : {10u, 60u, 200u}) {
    const auto nees = mine(parameters(), count, trials);
    EXPECT_NEAR(nees.coefficients, 1.0, 5.0 * std::sqrt(2.0 / (3.0 * trials))) << count;
    EXPECT_NEAR(nees.bias, 1.0, 5.0 * std::sqrt(2.0 / trials)) << count;
  }
}

/// Shared compass noise cancels between neighbours, which ThermalKf does not know: it is far too
/// cautious, its threefold use of each M notwithstanding.
TEST(ThermalKf, IsUnderconfidentWhereTheErrorIsSharedCompassNoise) {
  constexpr int trials = 1000;
  for (const std::size_t count : {60u, 200u}) {
    const auto kf = of_kf(parameters(), count, trials);
    EXPECT_LT(kf.coefficients, 0.2) << count;
    EXPECT_LT(mine(parameters(), count, trials).rmse, kf.rmse) << count;
  }
}

TEST(ThermalKf, IsOverconfidentByItsThreefoldUseOfEachMeasurementWhereTheErrorIsWhite) {
  constexpr int trials = 1000;
  const auto p = parameters(0.0, 0.01);
  EXPECT_NEAR(mine(p, 200, trials).coefficients, 1.0, 5.0 * std::sqrt(2.0 / (3.0 * trials)));
  EXPECT_GT(of_kf(p, 200, trials).coefficients, 2.0);
}

TEST(ThermalStfMa, WithAQuietCompassAndFactorOneIsAKalmanFilterThatUsesEachMeasurementOnce) {
  auto p = parameters(0.0, 0.01);
  p.process_a_std_dps_per_C = 1e-5;
  p.process_b_std_dps_s_per_C = 1e-3;
  p.process_c_std_dps = 5e-4;
  auto epochs = Drift(p, 100, 0).epochs;
  epochs[30].bias_dps = epochs[31].bias_dps = no_value;
  StfMaRule<double> rule(p);
  Gaussian<double, 3> state{p.coefficients(), p.initial_covariance()};
  for (const auto& epoch : epochs) {
    const auto s = rule.update(epoch);
    state.covariance += CoefficientWalk<double>(p).covariance();
    if (epoch.is_valid()) {
      const auto innovation = measurement_update<double, 3, 1>(
          state, Matrix<double, 1, 3>(epoch.regressors.transpose()),
          Matrix<double, 1>(p.bias_measurement_std_dps * p.bias_measurement_std_dps),
          Vector<double, 1>(epoch.bias_dps));
      EXPECT_NEAR(s->value(0), innovation.value(0), 1e-15);
      EXPECT_NEAR(s->covariance(0) / innovation.covariance(0), 1.0, 1e-12);
    }
    EXPECT_LT((rule.coefficients().mean - state.mean).norm(), 1e-14);
  }
}

TEST(ThermalStfMa, WhereItFadesTheInnovationVarianceIsThatOfTheInnovations) {
  auto p = parameters();
  p.adaptive = 1.0;
  auto epochs = Drift(p, 60, 0).epochs;
  for (std::size_t k = 30; k < 60; ++k) epochs[k].bias_dps += 0.2;
  StfMaRule<double> rule(p);
  double spread = 0.0;
  int faded = 0;
  for (std::size_t k = 0; k < epochs.size(); ++k) {
    const auto s = rule.update(epochs[k]);
    const double square = s->value(0) * s->value(0);
    spread = k == 0 ? square : (p.forgetting * spread + square) / (1.0 + p.forgetting);
    EXPECT_GE(s->covariance(0), spread * (1.0 - 1e-9));
    faded += std::abs(s->covariance(0) / spread - 1.0) < 1e-9;
  }
  EXPECT_GT(faded, 5);
}

TEST(ThermalStfMa, FollowsAChangeOfBiasFasterThanWithoutFading) {
  auto p = parameters();
  auto epochs = Drift(p, 60, 0).epochs;
  for (std::size_t k = 30; k < 60; ++k) epochs[k].bias_dps += 0.2;
  const auto error = [&](double adaptive) {
    p.adaptive = adaptive;
    StfMaRule<double> rule(p);
    for (std::size_t k = 0; k < 33; ++k) rule.update(epochs[k]);
    return std::abs(epochs[32].regressors.dot(rule.coefficients().mean) - epochs[32].bias_dps);
  };
  EXPECT_LT(error(1.0), 0.3 * error(0.0));
}

/// With the same regressors h throughout, P - P h h^T P / (h^T P h), the covariance given h X, is
/// that of the beginning, however hard it fades.
TEST(ThermalStfMa, FadesNothingThatTheMeasurementsDoNotSee) {
  auto p = parameters(0.0, 0.01);
  p.adaptive = 1.0;
  StfMaRule<double> rule(p);
  const auto unseen = [&](const Matrix<double, 3>& P, const Vector<double, 3>& h) {
    return Matrix<double, 3>(P - P * h * h.transpose() * P / h.dot(P * h));
  };
  BiasEpoch<double> epoch{.regressors = {30.0, 0.1, 1.0}};
  const auto expected = unseen(p.initial_covariance(), epoch.regressors);
  for (int k = 0; k < 50; ++k) {
    epoch.bias_dps = k % 10 < 5 ? 0.3 : -0.3;
    rule.update(epoch);
    EXPECT_LT((unseen(rule.coefficients().covariance, epoch.regressors) - expected).norm(), 1e-12);
  }
}

struct Disturbed {
  double stf_ma = 0.0, stf = 0.0, kf = 0.0;  ///< squared errors
};

/// A drift that is not linear and wanders, with the compass away from 300 s to 600 s while the
/// temperature moves on.
void add_disturbed(std::uint32_t trial, Disturbed& sum) {
  ThermalStfMa<double>::Parameters p;
  p.a_dps_per_C = 0.002;
  p.c_dps = -0.05;
  filters::ThermalStf<double>::Parameters q;
  static_cast<ThermalParameters<double>&>(q) = p;
  ThermalStfMa<double> stf_ma(p);
  filters::ThermalStf<double> stf(q);
  ThermalKf<double> kf(q);
  const NormalStream x(12, trial, "wander"), v(12, trial, "gyro"), n(12, trial, "heading");
  double wander = 0.0;
  for (std::uint64_t k = 0; k < 900; ++k) {
    const double t = static_cast<double>(k), T = 23.0 + 30.0 * std::sin(t / 250.0);
    wander += 0.006 * x.normal(k);
    const double bias = 0.002 * T - 0.05 + 2e-5 * (T - 23.0) * (T - 23.0) + wander;
    const Sample<double> sample{
        .t_s = t,
        .gyro_dps = bias + 0.005 * v.normal(k),
        .temperature_C = T,
        .heading_deg = t >= 300.0 && t < 600.0 ? no_value : 0.05 * n.normal(k)};
    sum.stf_ma += std::pow(stf_ma.step(sample).estimate_dps - bias, 2);
    sum.stf += std::pow(stf.step(sample).estimate_dps - bias, 2);
    sum.kf += std::pow(kf.step(sample).estimate_dps - bias, 2);
  }
}

TEST(ThermalStfMa, ExtrapolatesThroughADisturbanceThatThrowsThermalStf) {
  Disturbed sum;
  for (std::uint32_t trial = 0; trial < 20; ++trial) add_disturbed(trial, sum);
  EXPECT_LT(sum.stf_ma, 0.9 * sum.kf);
  EXPECT_LT(sum.stf_ma, 0.1 * sum.stf);
}

/// A compass that claims more noise than M has leaves a tenth of M's deviation to the white part.
TEST(ThermalStfMa, NeverTakesMToBeWithoutWhiteNoise) {
  auto p = parameters();
  p.compass_noise_std_deg *= 2.0;
  StfMaRule<double> rule(p);
  BiasEpoch<double> epoch{.regressors = {0.0, 0.0, 1.0}};
  epoch.bias_dps = 0.0;
  const double n = p.compass_noise_std_deg / interval_s;
  EXPECT_NEAR(rule.update(epoch)->covariance(0),
              p.initial_c_std_dps * p.initial_c_std_dps + 2.0 * n * n +
                  std::pow(0.1 * p.bias_measurement_std_dps, 2),
              1e-15);
}

/// The whole filter, compass and gyro in: the same law from samples, so that the sign of the shared
/// noise and the feedback of the held bias are right. The temperature steps at each epoch, so that
/// the drift is constant over an interval as M takes it to be.
TEST(ThermalStfMa, StatesTheVarianceOfItsErrorFromSamples) {
  constexpr int trials = 500, steps = 10;
  constexpr std::size_t epochs = 100;
  const auto p = parameters();
  double bias_nees = 0.0, nis = 0.0, correlation = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const Drift drift(p, epochs, trial);
    const NormalStream n(10, trial, "heading"), v(10, trial, "gyro");
    const double gyro_noise = std::sqrt(white_variance(p) * steps);
    ThermalStfMa<double> filter(p);
    double t = 0.0, T_before = 30.0, before = 0.0;
    filter.step({.t_s = 0.0,
                 .gyro_dps = 0.0,
                 .temperature_C = T_before,
                 .heading_deg = p.compass_noise_std_deg * n.normal(0)});
    for (std::size_t k = 0; k < epochs; ++k) {
      const double T = drift.epochs[k].regressors(0);
      const Vector<double, 3> h(T, (T - T_before) / interval_s, 1.0);
      const double bias = h.dot(drift.coefficients);
      Step<double> s;
      for (int i = 1; i <= steps; ++i) {
        t += interval_s / steps;
        s = filter.step(
            {.t_s = t,
             .gyro_dps = bias + gyro_noise * v.normal(steps * k + static_cast<unsigned>(i)),
             .temperature_C = i == steps ? T : T_before,
             .heading_deg = p.compass_noise_std_deg * n.normal(k + 1)});
      }
      T_before = T;
      const double e = s.innovation_dps / std::sqrt(s.innovation_variance);
      nis += e * e;
      correlation += k == 0 ? 0.0 : e * before;
      before = e;
      if (k + 1 == epochs) bias_nees += std::pow(s.estimate_dps - bias, 2) / s.estimate_variance;
    }
  }
  const double count = trials * static_cast<double>(epochs);
  EXPECT_NEAR(bias_nees / trials, 1.0, 5.0 * std::sqrt(2.0 / trials));
  EXPECT_NEAR(nis / count, 1.0, 5.0 * std::sqrt(2.0 / count));
  EXPECT_NEAR(correlation / count, 0.0, 5.0 / std::sqrt(count));
}

TEST(ThermalStfMa, HoldsItsEstimateWhileTheCompassIsDisturbed) {
  ThermalStfMa<double> filter(parameters());
  Step<double> s;
  for (int k = 0; k <= 100; ++k)
    s = filter.step({.t_s = 1.0 * k, .gyro_dps = 0.05, .temperature_C = 30.0, .heading_deg = 0.0});
  const double before = s.estimate_dps;
  for (int k = 101; k <= 400; ++k) {
    s = filter.step({.t_s = 1.0 * k, .gyro_dps = 0.05, .temperature_C = 30.0});
    EXPECT_EQ(s.status, Status::no_measurement);
    EXPECT_NEAR(s.estimate_dps, before, 1e-12);
  }
}

}  // namespace
}  // namespace gyrostat::thermal_stf_ma_test
