#include <gyrostat/core/models/gain_cycle.hpp>

#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/filters/kf_ma.hpp>
#include <gyrostat/core/filters/oracle.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::gain_cycle_test {
namespace {

template <class F>
class GainCycle : public testing::Test {};
using Filters = testing::Types<filters::Kf<double>, filters::KfMa<double>, filters::Oracle<double>>;
TYPED_TEST_SUITE(GainCycle, Filters);

Sample<double> sample_of(std::uint64_t k) {
  Sample<double> sample;
  sample.gyro_dps = 0.1 + 0.05 * NormalStream(3, 0, "gain cycle").normal(k);
  sample.true_rate_dps = 0.02;
  sample.true_drift_dps = 0.03;
  return sample;
}

/// After so many samples.
template <class F>
F filter_after(std::uint64_t samples, const Arima111<double>& arima) {
  typename F::Parameters p;
  static_cast<Arima111<double>&>(p) = arima;
  F filter(p);
  for (std::uint64_t k = 0; k < samples; ++k) filter.step(sample_of(k));
  return filter;
}

void expect_same_bits(const Step<double>& a, const Step<double>& b) {
  for (const auto value : {&Step<double>::estimate_dps, &Step<double>::estimate_variance,
                           &Step<double>::innovation_dps, &Step<double>::innovation_variance})
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.*value), std::bit_cast<std::uint64_t>(b.*value));
  EXPECT_EQ(a.status, b.status);
}

/// Of these models the covariance comes back after one, two or three steps.
constexpr Arima111<double> models[] = {
    {0.3, 0.002, 0.001, 0.05}, {0.9, 0.01, 0.002, 0.01}, {-0.3, 0.003, 0.001, 0.05}};

TYPED_TEST(GainCycle, ItsStepsAreThoseOfTheFilter) {
  constexpr std::uint64_t settled = 2000;
  for (const auto& model : models) {
    auto filter = filter_after<TypeParam>(settled, model), by_cycle = filter;
    auto cycle = by_cycle.cycle();
    ASSERT_TRUE(cycle.comes_round());
    Step<double> step;
    for (std::uint64_t k = settled; k < settled + 101; ++k) {
      ASSERT_TRUE(by_cycle.step(sample_of(k), cycle, step));
      expect_same_bits(step, filter.step(sample_of(k)));
    }
    by_cycle.end(cycle);
    for (std::uint64_t k = settled; k < settled + 10; ++k)
      expect_same_bits(by_cycle.step(sample_of(k)), filter.step(sample_of(k)));
  }
}

TYPED_TEST(GainCycle, IsNoneWhileTheCovarianceMoves) {
  EXPECT_FALSE(filter_after<TypeParam>(0, models[0]).cycle().comes_round());
  EXPECT_FALSE(filter_after<TypeParam>(20, models[0]).cycle().comes_round());
}

TYPED_TEST(GainCycle, EndsWhereThereIsNoMeasurement) {
  for (const double z : {no_value, std::numeric_limits<double>::infinity()}) {
    auto filter = filter_after<TypeParam>(2000, models[0]), by_cycle = filter;
    auto cycle = by_cycle.cycle();
    Step<double> step;
    auto sample = sample_of(0);
    sample.gyro_dps = z;
    EXPECT_FALSE(by_cycle.step(sample, cycle, step));
    by_cycle.end(cycle);
    expect_same_bits(by_cycle.step(sample), filter.step(sample));
  }
}

}  // namespace
}  // namespace gyrostat::gain_cycle_test
