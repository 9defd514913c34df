#include <gyrostat/core/filters/sr_rsukf_scalar.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/sr_rsukf.hpp>
#include <gyrostat/core/filters/sr_ukf.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/core/arima_signal.hpp>

namespace gyrostat::sr_rsukf_scalar_test {
namespace {

using filters::SrRsukf;
using filters::SrRsukfParameters;
using filters::SrRsukfScalar;
using filters::SrRsukfScalarParameters;
using filters::SrUkf;

NlParameters<double> model() {
  NlParameters<double> p;
  p.phi = 0.4;
  p.delta1_dps = 0.02;
  p.delta2_dps = 0.01;
  p.measurement_noise_std_dps = 0.02;
  p.initial_phi_std = 0.2;
  p.initial_delta1_std_dps = 0.01;
  p.initial_delta2_std_dps = 0.005;
  return p;
}

/// The same filter where rates are in units of which `per_dps` make one dps.
NlParameters<double> in_units(NlParameters<double> p, double per_dps) {
  for (double* value :
       {&p.delta1_dps, &p.delta2_dps, &p.measurement_noise_std_dps, &p.initial_x_std_dps,
        &p.initial_x_previous_std_dps, &p.initial_delta1_std_dps, &p.initial_delta2_std_dps})
    *value *= per_dps;
  return p;
}

SrRsukfScalar<double> scalar(const NlParameters<double>& p, double mu) {
  SrRsukfScalarParameters<double> q;
  static_cast<NlParameters<double>&>(q) = p;
  q.mu_scalar = mu;
  return SrRsukfScalar<double>(q);
}

SrRsukf<double> matrix(const NlParameters<double>& p, const Vector<double, 7>& mu) {
  SrRsukfParameters<double> q;
  static_cast<NlParameters<double>&>(q) = p;
  q.mu_x = mu(0);
  q.mu_x_previous = mu(1);
  q.mu_phi = mu(2);
  q.mu_delta1 = mu(3);
  q.mu_delta2 = mu(4);
  q.mu_a = mu(5);
  q.mu_a_previous = mu(6);
  return SrRsukf<double>(q);
}

std::vector<double> signal(std::size_t samples) {
  return arima_signal({0.6, 0.02, 0.01, 0.02}, samples, 3);
}

template <class A, class B>
void expect_same_bits(A a_filter, B b_filter, const std::vector<double>& z) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (const double value : z) {
    const auto a = step(a_filter, value), b = step(b_filter, value);
    EXPECT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
    EXPECT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
    EXPECT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
    EXPECT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
    EXPECT_EQ(a.status, b.status);
  }
}

std::vector<double> with_gaps() {
  auto z = signal(1000);
  for (std::size_t k = 300; k < 340; ++k) z[k] = no_value;
  z[60] = 1e5;
  z[90] = std::numeric_limits<double>::infinity();
  return z;
}

TEST(SrRsukfScalar, IsSrRsukfWithEqualRiskOfEveryStateBitForBit) {
  for (const double mu : {0.02, 0.2, 0.45, 2.0})
    expect_same_bits(scalar(model(), mu), matrix(model(), Vector<double, 7>::Constant(mu)),
                     with_gaps());
}

TEST(SrRsukfScalar, AtZeroRiskIsTheSrUkfBitForBit) {
  expect_same_bits(scalar(model(), 0.0), SrUkf<double>(model()), with_gaps());
}

TEST(SrRsukfScalar, FromARiskOfOneHalfTheNoiseStatesBreakItDown) {
  auto filter = scalar(model(), 0.5);
  for (const double z : signal(100)) EXPECT_EQ(step(filter, z).status, Status::risk_breakdown);
}

/// Largest difference between the estimates in dps of the filter that counts in dps and of the one
/// that counts in degrees an hour.
template <class F>
double effect_of_units(F in_dps, F in_dph) {
  double worst = 0.0;
  for (const double z : signal(300))
    worst = std::max(worst, std::abs(step(in_dps, z).estimate_dps -
                                     step(in_dph, 3600.0 * z).estimate_dps / 3600.0));
  return worst;
}

TEST(SrRsukfScalar, IsAnotherFilterInOtherUnitsOfRate) {
  EXPECT_GT(effect_of_units(scalar(model(), 0.1), scalar(in_units(model(), 3600.0), 0.1)), 1e-3);
}

TEST(SrRsukf, IsTheSameFilterInAnyUnitsOfRate) {
  Vector<double, 7> mu;
  mu << 30.0, 20.0, 0.1, 10.0, 10.0, 0.05, 0.05;
  Vector<double, 7> in_dph = mu;
  for (const int rate : {0, 1, 3, 4}) in_dph(rate) /= 3600.0 * 3600.0;
  EXPECT_LT(effect_of_units(matrix(model(), mu), matrix(in_units(model(), 3600.0), in_dph)), 1e-12);
}

}  // namespace
}  // namespace gyrostat::sr_rsukf_scalar_test
