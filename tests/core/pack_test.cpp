#include <gyrostat/core/packed/pack.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/packed/kernels.hpp>
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
std::vector<double> parameters_of(const FilterType& filter, int lane) {
  std::vector<double> values;
  for (const auto& field : filter.fields) {
    double value = field.value;
    if (field.name.starts_with("mu_"))
      value = lane % 3 == 1 ? 0.0 : 0.01 * (1 + lane);
    else if (!field.range.whole && field.range.contains(value * (1.0 + 0.05 * lane)))
      value *= 1.0 + 0.05 * lane;
    if (lane == 5 && field.name.find("std") != std::string_view::npos && field.range.contains(0.0))
      value = 0.0;
    values.push_back(value);
  }
  return values;
}

/// What a filter makes of samples in lanes.
struct Steps {
  explicit Steps(std::size_t count) {
    for (auto* column : {&estimate, &variance, &innovation, &innovation_variance, &status})
      column->resize(count);
  }
  PackedSteps out(std::size_t lane = 0) {
    return {&estimate[lane], &variance[lane], &innovation[lane], &innovation_variance[lane],
            &status[lane]};
  }
  std::vector<double> estimate, variance, innovation, innovation_variance, status;
};

std::vector<std::string> packed_filters() {
  std::vector<std::string> ids;
  for (const auto* unit : available_kernels().front()->filters)
    for (const auto& kernel : *unit) ids.emplace_back(kernel.filter);
  return ids;
}

class Packed : public testing::TestWithParam<std::string> {};

/// Of every kernel that this machine can run.
TEST_P(Packed, IsItselfInEveryLane) {
  constexpr std::size_t samples = 3000;
  const auto& filter = filter_types().named(GetParam(), "test");
  std::size_t kernels_met = 0;
  for (const auto* target : available_kernels())
    for (const auto* unit : target->filters)
      for (const auto& kernel : *unit) {
        if (kernel.filter != GetParam()) continue;
        ++kernels_met;
        const auto lanes = static_cast<std::size_t>(kernel.lanes);
        std::vector<double> gyro(samples * lanes), truth(samples * lanes, 0.0), t(samples, 0.0);
        std::vector<double> parameters(filter.fields.size() * lanes);
        Steps packed(samples * lanes), alone(samples * lanes);
        for (std::size_t l = 0; l < lanes; ++l) {
          for (std::size_t k = 0; k < samples; ++k)
            gyro[k * lanes + l] = sample_of(static_cast<int>(l), k);
          const auto own = parameters_of(filter, static_cast<int>(l));
          for (std::size_t f = 0; f < own.size(); ++f) parameters[f * lanes + l] = own[f];
          filter.start(own)->run({.t_s = t.data(),
                                  .gyro_dps = &gyro[l],
                                  .true_rate_dps = &truth[l],
                                  .true_drift_dps = &truth[l],
                                  .gyro_stride = lanes,
                                  .truth_stride = lanes},
                                 alone.out(l), lanes, samples);
        }
        const std::unique_ptr<void, decltype(&std::free)> state(
            std::aligned_alloc(64, (kernel.bytes + 63) / 64 * 64), &std::free);
        kernel.start(state.get(), parameters.data());
        kernel.run(state.get(), {gyro.data(), truth.data(), truth.data()}, packed.out(), samples);
        const auto where = [&](std::size_t i) {
          return std::string(target->target) + ", lane " + std::to_string(i % lanes) + ", sample " +
                 std::to_string(i / lanes);
        };
        for (std::size_t i = 0; i < samples * lanes; ++i) {
          ASSERT_EQ(bits(packed.estimate[i]), bits(alone.estimate[i])) << where(i);
          ASSERT_EQ(bits(packed.variance[i]), bits(alone.variance[i])) << where(i);
          ASSERT_EQ(bits(packed.innovation[i]), bits(alone.innovation[i])) << where(i);
          ASSERT_EQ(bits(packed.innovation_variance[i]), bits(alone.innovation_variance[i]))
              << where(i);
          ASSERT_EQ(packed.status[i], alone.status[i]) << where(i);
        }
      }
  EXPECT_GE(kernels_met, available_kernels().size());
}

INSTANTIATE_TEST_SUITE_P(Each, Packed, testing::ValuesIn(packed_filters()),
                         [](const auto& filter) { return filter.param; });

}  // namespace
}  // namespace gyrostat::pack_test
