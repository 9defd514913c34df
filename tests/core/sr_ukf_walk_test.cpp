#include <gyrostat/core/filters/sr_ukf_walk.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/sr_ukf.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/core/arima_signal.hpp>

namespace gyrostat::sr_ukf_walk_test {
namespace {

using filters::SrUkf;
using filters::SrUkfWalk;
using Parameters = filters::SrUkfWalkParameters<double>;

Parameters parameters(double walk_phi, double walk_delta1 = 0.0, double walk_delta2 = 0.0) {
  Parameters p;
  p.phi = 0.8;
  p.delta1_dps = 0.02;
  p.delta2_dps = 0.0;
  p.measurement_noise_std_dps = 0.005;
  p.initial_phi_std = 0.2;
  p.initial_delta1_std_dps = p.initial_delta2_std_dps = 0.002;
  p.walk_phi_std = walk_phi;
  p.walk_delta1_std_dps = walk_delta1;
  p.walk_delta2_std_dps = walk_delta2;
  return p;
}

/// x with phi = 0.8 until the middle and -0.4 from there on, in white noise.
std::vector<double> changing(std::size_t samples, std::uint32_t trial) {
  const NormalStream a(4, trial, "a"), v(4, trial, "v");
  std::vector<double> z(samples);
  double x = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    difference = (k < samples / 2 ? 0.8 : -0.4) * difference + 0.02 * a.normal(k);
    x += difference;
    z[k] = x + 0.005 * v.normal(k);
  }
  return z;
}

double variance(const NlUnscented<double>& state, int i) {
  return state.root().row(i).squaredNorm();
}

TEST(SrUkfWalk, WithoutAWalkIsTheSrUkfBitForBit) {
  auto z = changing(1000, 0);
  z[30] = no_value;
  z[60] = 1e5;
  z[90] = std::numeric_limits<double>::infinity();
  SrUkfWalk<double> with(parameters(0.0));
  SrUkf<double> without(parameters(0.0));
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (const double value : z) {
    const auto a = step(with, value), b = step(without, value);
    EXPECT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
    EXPECT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
    EXPECT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
    EXPECT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
    EXPECT_EQ(a.status, b.status);
  }
  EXPECT_EQ(with.state().root(), without.state().root());
}

TEST(NlUnscented, AWalkAddsItsVarianceToTheParametersAlone) {
  NlUnscented<double> state(parameters(0.0));
  for (const double z : changing(20, 0)) {
    ASSERT_TRUE(state.time_update());
    state.measurement_update(z);
  }
  auto walked = state;
  walked.walk_parameters({0.1, 0.02, 0.003});
  Vector<double, 7> added = Vector<double, 7>::Zero();
  added.segment<3>(2) << 0.01, 4e-4, 9e-6;
  const Matrix<double, 7> difference =
      walked.root() * walked.root().transpose() - state.root() * state.root().transpose();
  EXPECT_LT((difference - Matrix<double, 7>(added.asDiagonal())).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(walked.mean(), state.mean());
}

/// Mean over trials of the distance of phi from its true value at the end, in filter F.
template <class F>
double distance_of_phi(double walk_phi) {
  constexpr int trials = 50;
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    F filter(parameters(walk_phi));
    for (const double z : changing(6000, trial)) step(filter, z);
    sum += std::abs(filter.state().mean()(2) + 0.4);
  }
  return sum / trials;
}

TEST(SrUkfWalk, PhiFollowsAChangeThatTheSrUkfHasClosedItselfTo) {
  EXPECT_LT(distance_of_phi<SrUkfWalk<double>>(0.003), 0.1);
  EXPECT_GT(distance_of_phi<SrUkf<double>>(0.003), 0.4);
}

TEST(SrUkfWalk, AWalkOfDelta1AddsUpWhateverTheData) {
  const auto p = parameters(0.0, 1e-3);
  SrUkfWalk<double> filter(p);
  double k = 0.0;
  for (const double z : changing(2000, 0)) {
    step(filter, z);
    const double expected = p.initial_delta1_std_dps * p.initial_delta1_std_dps + 1e-6 * ++k;
    EXPECT_NEAR(variance(filter.state(), 3) / expected, 1.0, 1e-9);
    EXPECT_NEAR(filter.state().mean()(3), p.delta1_dps, 1e-12);
  }
}

}  // namespace
}  // namespace gyrostat::sr_ukf_walk_test
