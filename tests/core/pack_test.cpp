#include <gyrostat/core/packed/pack.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::pack_test {
namespace {

struct Baseline {
  static constexpr int width = 2;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v); }

TEST(Pack, ComparesAndSelectsLaneByLane) {
  using P = Pack<Baseline, 4>;
  const std::array a = {1.0, -2.0, no_value, infinity}, b = {1.0, 3.0, 0.0, infinity};
  const P x = P::load(a.data()), y = P::load(b.data());
  const P chosen = select(x == y, P(7.0), x);
  EXPECT_EQ(chosen[0], 7.0);
  EXPECT_EQ(chosen[1], -2.0);
  EXPECT_TRUE(std::isnan(chosen[2]));
  EXPECT_EQ(chosen[3], 7.0);
  EXPECT_TRUE(any(isnan(x)) && !all(isnan(x)) && isnan(x)[2]);
  EXPECT_TRUE(isfinite(x)[1] && !isfinite(x)[2] && !isfinite(x)[3]);
  EXPECT_TRUE((x < y)[1] && !(x < y)[0] && !(x >= y)[2]);
}

/// Lanes of noise, each with its own troubles: gaps, outliers, what is not finite, and what breaks
/// a filter down.
double sample_of(int lane, std::size_t k) {
  const double z = 0.05 * NormalStream(5, static_cast<std::uint32_t>(lane), "pack").normal(k);
  switch (lane % 4) {
    case 1:
      return k % 7 == 0 ? no_value : z;
    case 2:
      return k % 11 == 3 ? infinity : k % 13 == 5 ? 1e200 : z;
    case 3:
      return k % 50 < 20 ? no_value : 100.0 * z;
    default:
      return z;
  }
}

/// The parameters of a lane: no two alike, some at zero.
template <class P>
P parameters_of(int lane) {
  P p;
  for (const auto& field : p.fields()) {
    double& value = p.*(field.member);
    if (field.name.starts_with("mu_"))
      value = lane % 3 == 1 ? 0.0 : 0.01 * (1 + lane);
    else if (!field.range.whole && field.range.contains(value * (1.0 + 0.05 * lane)))
      value *= 1.0 + 0.05 * lane;
    if (lane == 5 && field.name.find("std") != std::string_view::npos && field.range.contains(0.0))
      value = 0.0;
  }
  return p;
}

/// Each lane of `Filter` on packs against the same filter alone, over `steps` samples.
template <template <class> class Filter, int N>
void expect_lanes_are_doubles(std::size_t steps) {
  using P = Pack<Baseline, N>;
  typename Filter<P>::Parameters packed;
  std::vector<Filter<double>> alone;
  const auto fields = packed.fields();
  std::array<std::array<double, N>, 32> values{};
  for (int lane = 0; lane < N; ++lane) {
    const auto p = parameters_of<typename Filter<double>::Parameters>(lane);
    alone.emplace_back(p);
    for (std::size_t f = 0; f < fields.size(); ++f) values[f][lane] = p.*(p.fields()[f].member);
  }
  for (std::size_t f = 0; f < fields.size(); ++f)
    packed.*(fields[f].member) = P::load(values[f].data());
  Filter<P> filter(packed);
  for (std::size_t k = 0; k < steps; ++k) {
    std::array<double, N> z{}, zero{};
    for (int lane = 0; lane < N; ++lane) z[lane] = sample_of(lane, k);
    Sample<P> sample;
    sample.gyro_dps = P::load(z.data());
    sample.true_rate_dps = sample.true_drift_dps = P::load(zero.data());
    const auto step = filter.step(sample);
    for (int lane = 0; lane < N; ++lane) {
      const auto one =
          alone[lane].step({.gyro_dps = z[lane], .true_rate_dps = 0.0, .true_drift_dps = 0.0});
      ASSERT_EQ(bits(step.estimate_dps[lane]), bits(one.estimate_dps)) << lane << ", " << k;
      ASSERT_EQ(bits(step.estimate_variance[lane]), bits(one.estimate_variance))
          << lane << ", " << k;
      ASSERT_EQ(bits(step.innovation_dps[lane]), bits(one.innovation_dps)) << lane << ", " << k;
      ASSERT_EQ(bits(step.innovation_variance[lane]), bits(one.innovation_variance))
          << lane << ", " << k;
      ASSERT_EQ(static_cast<Status>(static_cast<int>(step.status.code[lane])), one.status)
          << lane << ", " << k;
    }
  }
}

template <template <class> class Filter>
void expect_lanes_are_doubles() {
  expect_lanes_are_doubles<Filter, 2>(1000);
  expect_lanes_are_doubles<Filter, 4>(1000);
  expect_lanes_are_doubles<Filter, 8>(3000);
}

TEST(Packed, NoneIsItselfInEveryLane) { expect_lanes_are_doubles<filters::None>(); }
TEST(Packed, KfIsItselfInEveryLane) { expect_lanes_are_doubles<filters::Kf>(); }
TEST(Packed, KfMaIsItselfInEveryLane) { expect_lanes_are_doubles<filters::KfMa>(); }
TEST(Packed, OracleIsItselfInEveryLane) { expect_lanes_are_doubles<filters::Oracle>(); }
TEST(Packed, StfIsItselfInEveryLane) { expect_lanes_are_doubles<filters::Stf>(); }
TEST(Packed, RskfIsItselfInEveryLane) { expect_lanes_are_doubles<filters::Rskf>(); }
TEST(Packed, SrUkfIsItselfInEveryLane) { expect_lanes_are_doubles<filters::SrUkf>(); }
TEST(Packed, SrUkfWalkIsItselfInEveryLane) { expect_lanes_are_doubles<filters::SrUkfWalk>(); }
TEST(Packed, SrRsukfIsItselfInEveryLane) { expect_lanes_are_doubles<filters::SrRsukf>(); }
TEST(Packed, SrRsukfScalarIsItselfInEveryLane) {
  expect_lanes_are_doubles<filters::SrRsukfScalar>();
}

}  // namespace
}  // namespace gyrostat::pack_test
