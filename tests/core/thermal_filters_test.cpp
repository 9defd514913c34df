#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gyrostat/core/filters/thermal_kf.hpp>
#include <gyrostat/core/filters/thermal_lsm.hpp>
#include <gyrostat/core/filters/thermal_mlr.hpp>
#include <gyrostat/core/filters/thermal_stf.hpp>
#include <gyrostat/core/models/thermal.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::thermal_filters_test {
namespace {

using filters::ThermalKf;
using filters::ThermalLsm;
using filters::ThermalMlr;
using filters::ThermalStf;

constexpr double step_s = 0.1;
constexpr int steps_per_epoch = 100;
constexpr double interval_s = steps_per_epoch * step_s;

constexpr ThermalDrift<double> truth{.a_dps_per_C = 0.004, .b_dps_s_per_C = 0.3, .c_dps = -0.07};

/// A chamber's cycle of ten minutes.
double temperature(double t_s) {
  return 40.0 + 17.0 * std::sin(2.0 * std::numbers::pi * t_s / 600.0);
}

double slope(int epoch) {
  const double t = epoch * interval_s;
  return epoch == 0 ? 0.0 : (temperature(t) - temperature(t - interval_s)) / interval_s;
}

/// A gyro turning at `rate_dps` whose drift is exactly linear in the T and T' of the epoch that it
/// leads to, with a compass of white noise.
std::vector<Sample<double>> record(int epochs, double rate_dps = 0.0,
                                   double compass_std_deg = 0.0) {
  const NormalStream compass(5, 0, "compass");
  std::vector<Sample<double>> samples;
  for (int i = 0; i <= epochs * steps_per_epoch; ++i) {
    const double t = i * step_s;
    const int epoch = (i + steps_per_epoch - 1) / steps_per_epoch;
    const double bias = truth.a_dps_per_C * temperature(epoch * interval_s) +
                        truth.b_dps_s_per_C * slope(epoch) + truth.c_dps;
    samples.push_back({.t_s = t,
                       .gyro_dps = rate_dps + bias,
                       .temperature_C = temperature(t),
                       .heading_deg = wrap_degrees(
                           170.0 + rate_dps * t +
                           compass_std_deg * compass.normal(static_cast<std::uint64_t>(i)))});
  }
  return samples;
}

/// Parameters that know nothing of the drift.
template <class Parameters>
Parameters vague() {
  Parameters p;
  p.initial_a_std_dps_per_C = 1.0;
  p.initial_b_std_dps_s_per_C = 100.0;
  p.initial_c_std_dps = 10.0;
  p.bias_measurement_std_dps = 1e-4;
  p.update_interval_s = interval_s;
  return p;
}

template <class F>
void expect_finds_the_truth(const F& filter) {
  const auto& found = filter.rule().coefficients().mean;
  EXPECT_NEAR(found(0), truth.a_dps_per_C, 1e-7);
  EXPECT_NEAR(found(1), truth.b_dps_s_per_C, 1e-5);
  EXPECT_NEAR(found(2), truth.c_dps, 1e-6);
}

/// M of every whole interval of a gyro with `bias_dps` that turns at `rate_dps`, under a perfect
/// compass, with `held_dps` as the bias already compensated.
std::vector<double> measured_bias(double bias_dps, double rate_dps, double held_dps) {
  CompassAiding<double> aiding(interval_s);
  std::vector<double> measured;
  for (int i = 0; i <= 20 * steps_per_epoch; ++i) {
    const double t = i * step_s;
    const auto epoch = aiding.observe({.t_s = t,
                                       .gyro_dps = rate_dps + bias_dps,
                                       .temperature_C = 20.0,
                                       .heading_deg = wrap_degrees(rate_dps * t)},
                                      held_dps);
    if (epoch && i > 0) measured.push_back(epoch->bias_dps);
  }
  return measured;
}

TEST(CompassAiding, MeasuresAConstantBiasExactlyWithItsSign) {
  for (const double bias : {0.3, -0.3, 2.0})
    for (const double held : {0.0, 0.1, -1.0}) {
      const auto M = measured_bias(bias, 0.0, held);
      EXPECT_EQ(M.size(), 20U);
      for (const double m : M) EXPECT_NEAR(m, bias, 1e-12);
    }
}

TEST(CompassAiding, MeasuresItWhileTurningThroughTheWrap) {
  for (const double rate : {1.0, -7.0, 18.0, 36.0, 250.0})
    for (const double m : measured_bias(0.3, rate, 0.1)) EXPECT_NEAR(m, 0.3, 1e-9) << rate;
}

/// Beyond half a turn of A_c - A_g in an interval the compass cannot tell by how many turns.
TEST(CompassAiding, IsAmbiguousByWholeTurnsAnInterval) {
  for (const double m : measured_bias(20.0, 0.0, 0.0)) EXPECT_NEAR(m, 20.0 - 36.0, 1e-9);
}

TEST(CompassAiding, TheFirstEpochHasNoBiasAndTheSlopeIsThatOfTheInterval) {
  CompassAiding<double> aiding(interval_s);
  int epochs = 0;
  for (const auto& sample : record(5)) {
    const auto epoch = aiding.observe(sample, 0.0);
    if (!epoch) continue;
    EXPECT_EQ(epoch->is_valid(), epochs > 0);
    EXPECT_DOUBLE_EQ(epoch->regressors(0), temperature(epochs * interval_s));
    EXPECT_NEAR(epoch->regressors(1), slope(epochs), 1e-12);
    EXPECT_EQ(epoch->regressors(2), 1.0);
    ++epochs;
  }
  EXPECT_EQ(epochs, 6);
}

TEST(CompassAiding, AMissingHeadingAtEitherEndLeavesTheIntervalWithoutABias) {
  auto samples = record(5);
  samples[2 * steps_per_epoch].heading_deg = no_value;
  CompassAiding<double> aiding(interval_s);
  std::vector<bool> valid;
  for (const auto& sample : samples)
    if (const auto epoch = aiding.observe(sample, 0.0)) valid.push_back(epoch->is_valid());
  EXPECT_EQ(valid, (std::vector<bool>{false, true, false, false, true, true}));
}

// M has standard deviation sqrt(2) s / dt and, neighbours sharing a compass sample, a correlation
// of -1/2 at lag 1. Over n values: Bartlett's standard errors, sqrt(2 (1 + 2/4) / n) of the
// relative variance and sqrt((1 - 3/4 + 4/16) / n) of the correlation; each fails falsely at 6e-7.
TEST(CompassAiding, NeighbouringMeasurementsShareACompassSample) {
  constexpr int n = 4000;
  const double s = 0.05;
  CompassAiding<double> aiding(interval_s);
  std::vector<double> error;
  const NormalStream compass(6, 0, "compass");
  for (int k = 0; k <= n; ++k) {
    const auto epoch =
        aiding.observe({.t_s = k * interval_s,
                        .gyro_dps = 0.2,
                        .heading_deg = s * compass.normal(static_cast<std::uint64_t>(k))},
                       0.0);
    if (k > 0) error.push_back(epoch->bias_dps - 0.2);
  }
  double square = 0.0, product = 0.0;
  for (std::size_t k = 0; k < error.size(); ++k) {
    square += error[k] * error[k] / n;
    if (k > 0) product += error[k] * error[k - 1] / n;
  }
  const double variance = 2.0 * s * s / (interval_s * interval_s);
  EXPECT_NEAR(square / variance, 1.0, 5.0 * std::sqrt(3.0 / n));
  EXPECT_NEAR(product / square, -0.5, 5.0 * std::sqrt(0.5 / n));
}

template <class F>
class ThermalFilter : public testing::Test {};

struct FilterNames {
  template <class F>
  static std::string GetName(int index) {
    constexpr std::array names = {"ThermalMlr", "ThermalKf", "ThermalLsm", "ThermalStf"};
    return names[static_cast<std::size_t>(index)];
  }
};

using All =
    testing::Types<ThermalMlr<double>, ThermalKf<double>, ThermalLsm<double>, ThermalStf<double>>;
TYPED_TEST_SUITE(ThermalFilter, All, FilterNames);

TYPED_TEST(ThermalFilter, FromTheTruthStaysAtTheTruth) {
  typename TypeParam::Parameters p;
  static_cast<ThermalDrift<double>&>(p) = truth;
  TypeParam filter(p);
  for (const auto& sample : record(100, 5.0)) filter.step(sample);
  EXPECT_LT((filter.rule().coefficients().mean - coefficients_of(truth)).norm(), 1e-10);
}

TYPED_TEST(ThermalFilter, LearnsNothingWhileTheCompassIsFlagged) {
  auto samples = record(100, 5.0, 0.05);
  const auto disturbed = [](std::size_t i) {
    return i >= 40 * steps_per_epoch && i < 70 * steps_per_epoch;
  };
  TypeParam filter(vague<typename TypeParam::Parameters>());
  Vector<double, 3> before;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (disturbed(i)) samples[i].heading_deg = no_value;
    const auto s = filter.step(samples[i]);
    if (i == 40 * steps_per_epoch) before = filter.rule().coefficients().mean;
    if (!disturbed(i)) continue;
    EXPECT_EQ(name_of(s.status), "no_measurement");
    EXPECT_EQ(filter.rule().coefficients().mean, before);
  }
  // Still moving with the temperature, by the last coefficients.
  TypeParam again(vague<typename TypeParam::Parameters>());
  for (std::size_t i = 0; i <= 50 * steps_per_epoch; ++i) {
    const double estimate = again.step(samples[i]).estimate_dps;
    if (i < 50 * steps_per_epoch) continue;
    EXPECT_DOUBLE_EQ(estimate, before(0) * temperature(500.0) + before(1) * slope(50) + before(2));
  }
}

TYPED_TEST(ThermalFilter, HoldsItsBiasBetweenEpochs) {
  TypeParam filter(vague<typename TypeParam::Parameters>());
  const auto samples = record(20, 0.0, 0.05);
  double held = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto s = filter.step(samples[i]);
    if (i % steps_per_epoch == 0)
      held = s.estimate_dps;
    else
      EXPECT_EQ(s.estimate_dps, held);
  }
}

TYPED_TEST(ThermalFilter, FollowsTheTemperatureBetweenEpochsOnRequest) {
  auto p = vague<typename TypeParam::Parameters>();
  p.follows_temperature = 1.0;
  TypeParam follows(p), holds(vague<typename TypeParam::Parameters>());
  const auto samples = record(20, 0.0, 0.05);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double estimate = follows.step(samples[i]).estimate_dps;
    const double held = holds.step(samples[i]).estimate_dps;
    // What is learnt does not depend on what is compensated meanwhile, but for rounding.
    const auto& learnt = follows.rule().coefficients().mean;
    EXPECT_LT((learnt - holds.rule().coefficients().mean).norm(), 1e-9);
    if (i % steps_per_epoch == 0)
      EXPECT_NEAR(estimate, held, 1e-9);
    else
      EXPECT_NEAR(
          estimate - held,
          learnt(0) * (samples[i].temperature_C - samples[i - i % steps_per_epoch].temperature_C),
          1e-9);
  }
}

/// Until the rule has learnt again, which a Kalman filter on three successive M does two intervals
/// after the first that is valid; MLR, which learns nothing, is back with the compass.
TYPED_TEST(ThermalFilter, KeepsItsBiasWithoutACompassOnRequest) {
  auto samples = record(100, 5.0, 0.05);
  for (std::size_t i = 40 * steps_per_epoch; i < 70 * steps_per_epoch; ++i)
    samples[i].heading_deg = no_value;
  constexpr bool is_kalman =
      std::is_same_v<TypeParam, ThermalKf<double>> || std::is_same_v<TypeParam, ThermalStf<double>>;
  const std::size_t back = (is_kalman ? 73 : 71) * steps_per_epoch;
  for (const double follows_temperature : {0.0, 1.0}) {
    auto p = vague<typename TypeParam::Parameters>();
    static_cast<ThermalDrift<double>&>(p) = truth;
    p.keeps_bias = 1.0;
    p.follows_temperature = follows_temperature;
    TypeParam filter(p);
    double before = 0.0;
    for (std::size_t i = 0; i <= back; ++i) {
      const double estimate = filter.step(samples[i]).estimate_dps;
      if (i == 40 * steps_per_epoch - 1) before = estimate;
      if (i >= 40 * steps_per_epoch && i < back) {
        EXPECT_EQ(estimate, before) << i;
      }
      if (i == back) {
        EXPECT_NE(estimate, before);
      }
    }
  }
}

TEST(ThermalMlr, KeepsItsCoefficientsWhateverTheData) {
  ThermalParameters<double> p;
  static_cast<ThermalDrift<double>&>(p) = {
      .a_dps_per_C = 0.001, .b_dps_s_per_C = 0.1, .c_dps = 0.2};
  ThermalMlr<double> filter(p);
  for (const auto& sample : record(50, 3.0, 1.0)) {
    filter.step(sample);
    EXPECT_EQ(filter.rule().coefficients().mean, p.coefficients());
  }
}

TEST(ThermalLsm, RecoversALinearDrift) {
  ThermalLsm<double> filter(vague<ThermalLsm<double>::Parameters>());
  for (const auto& sample : record(60)) filter.step(sample);
  expect_finds_the_truth(filter);
}

TEST(ThermalKf, RecoversALinearDriftThatDoesNotWalk) {
  auto p = vague<ThermalKf<double>::Parameters>();
  p.process_a_std_dps_per_C = p.process_b_std_dps_s_per_C = p.process_c_std_dps = 0.0;
  ThermalKf<double> filter(p);
  for (const auto& sample : record(60)) filter.step(sample);
  expect_finds_the_truth(filter);
}

TEST(ThermalStf, RecoversALinearDriftThatDoesNotWalk) {
  auto p = vague<ThermalStf<double>::Parameters>();
  p.process_a_std_dps_per_C = p.process_b_std_dps_s_per_C = p.process_c_std_dps = 0.0;
  ThermalStf<double> filter(p);
  for (const auto& sample : record(60)) filter.step(sample);
  expect_finds_the_truth(filter);
}

TEST(ThermalStf, WithAFixedFactorOfOneIsThermalKfBitForBit) {
  ThermalStf<double>::Parameters p;
  p.adaptive = 0.0;
  ThermalStf<double> stf(p);
  ThermalKf<double> kf(p);
  auto samples = record(200, 7.0, 0.1);
  for (std::size_t i = 80 * steps_per_epoch; i < 100 * steps_per_epoch; ++i)
    samples[i].heading_deg = no_value;
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (const auto& sample : samples) {
    const auto a = stf.step(sample), b = kf.step(sample);
    EXPECT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
    EXPECT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
    EXPECT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
    EXPECT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
    EXPECT_EQ(a.status, b.status);
  }
}

/// A warm-up that ends: from then on T and 1 are collinear and T' is zero, so that one direction of
/// [a, b, c] is observed and two are not.
TYPED_TEST(ThermalFilter, KeepsASoundCovarianceAtConstantTemperature) {
  TypeParam filter(typename TypeParam::Parameters{});
  const NormalStream compass(7, 0, "compass");
  for (int k = 0; k < 7200; ++k) {
    const double t = k;
    const auto s =
        filter.step({.t_s = t,
                     .gyro_dps = 0.1,
                     .temperature_C = 40.1 - 2.3 * std::exp(-t / 20.0),
                     .heading_deg = 0.05 * compass.normal(static_cast<std::uint64_t>(k))});
    ASSERT_GT(s.estimate_variance, 0.0) << t << " s";
    // Fading multiplies the variance of what is not observed without end: the strong tracking
    // filter winds up here, and has to say so.
    if (std::is_same_v<TypeParam, filters::ThermalStf<double>>) continue;
    ASSERT_FALSE(is_breakdown(s.status)) << t << " s: " << name_of(s.status);
    const Vector<double, 3> variances = filter.rule().coefficients().covariance.diagonal();
    ASSERT_GT(variances.minCoeff(), 0.0) << t << " s";
  }
}

/// The epochs that a filter has seen, by its own held bias.
template <class F>
std::vector<BiasEpoch<double>> epochs_of(F& filter, const std::vector<Sample<double>>& samples) {
  CompassAiding<double> aiding(interval_s);
  std::vector<BiasEpoch<double>> epochs;
  double held = 0.0;
  for (const auto& sample : samples) {
    if (const auto epoch = aiding.observe(sample, held); epoch && epoch->is_valid())
      epochs.push_back(*epoch);
    held = filter.step(sample).estimate_dps;
  }
  return epochs;
}

TEST(ThermalLsm, WithAHugePriorIsOrdinaryLeastSquaresOverItsWindow) {
  for (const int window : {10, 30, 1000}) {
    auto p = vague<ThermalLsm<double>::Parameters>();
    p.initial_a_std_dps_per_C = p.initial_c_std_dps = 1e4;
    p.initial_b_std_dps_s_per_C = 1e6;
    p.bias_measurement_std_dps = 0.01;
    p.window_points = window;
    ThermalLsm<double> filter(p);
    const auto epochs = epochs_of(filter, record(80, 2.0, 0.05));
    ASSERT_EQ(epochs.size(), 80U);
    const auto used = std::min<std::ptrdiff_t>(window, std::ssize(epochs));
    Eigen::MatrixXd X(used, 3);
    Eigen::VectorXd y(used);
    for (std::ptrdiff_t k = 0; k < used; ++k) {
      const auto& epoch = epochs[epochs.size() - static_cast<std::size_t>(used - k)];
      X.row(k) = epoch.regressors.transpose();
      y(k) = epoch.bias_dps;
    }
    const Eigen::Vector3d expected = least_squares(X, y).solution;
    const Eigen::Matrix3d covariance = 1e-4 * invert_symmetric(X.transpose() * X).inverse;
    const auto& found = filter.rule().coefficients();
    for (int i = 0; i < 3; ++i) {
      const double std = std::sqrt(covariance(i, i));
      EXPECT_NEAR(found.mean(i), expected(i), 1e-6 * std) << "window " << window;
      EXPECT_NEAR(std::sqrt(found.covariance(i, i)), std, 1e-6 * std) << "window " << window;
    }
  }
}

/// y_k holds each M up to three times, so with a huge prior and no walk the Kalman filter is least
/// squares with the inner epochs at weight three and the two at either end at less.
TEST(ThermalKf, WithAHugePriorIsLeastSquaresThatCountsEachEpochThrice) {
  auto p = vague<ThermalKf<double>::Parameters>();
  p.process_a_std_dps_per_C = p.process_b_std_dps_s_per_C = p.process_c_std_dps = 0.0;
  p.initial_b_std_dps_s_per_C = 1e3;
  p.bias_measurement_std_dps = 0.01;
  ThermalKf<double> filter(p);
  const auto epochs = epochs_of(filter, record(80, 2.0, 0.05));
  const auto n = std::ssize(epochs);
  Eigen::MatrixXd X(n, 3);
  Eigen::VectorXd y(n);
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const double weight =
        std::sqrt(static_cast<double>(std::min({k + 1, n - k, std::ptrdiff_t{3}})));
    X.row(k) = weight * epochs[static_cast<std::size_t>(k)].regressors.transpose();
    y(k) = weight * epochs[static_cast<std::size_t>(k)].bias_dps;
  }
  const Eigen::Vector3d expected = least_squares(X, y).solution;
  const Eigen::Matrix3d covariance = 1e-4 * invert_symmetric(X.transpose() * X).inverse;
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(filter.rule().coefficients().mean(i), expected(i),
                1e-3 * std::sqrt(covariance(i, i)));
}

}  // namespace
}  // namespace gyrostat::thermal_filters_test
