#include <gyrostat/core/held/kernels.hpp>

#include <bit>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/thermal_kf.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::held_test {
namespace {

using Filter = filters::ThermalKf<double>;

constexpr double step_s = 0.1;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

Sample<double> sample(std::size_t lane, std::size_t k) {
  const NormalStream noise(3, static_cast<std::uint32_t>(lane), "gyro");
  const double t_s = static_cast<double>(k) * step_s;
  return {.t_s = t_s,
          .gyro_dps = -0.03 + 0.02 * noise.normal(k),
          .temperature_C = 30.0 + 5.0 * std::sin(0.05 * t_s),
          .heading_deg = 0.1 * noise.normal(100000 + k)};
}

Filter filter_with(double interval_s, double follows = 0.0) {
  Filter::Parameters p;
  p.a_dps_per_C = 0.001;
  p.update_interval_s = interval_s;
  p.follows_temperature = follows;
  return Filter(p);
}

/// Trials side by side at sample `first`, and what the kernel makes of some more.
struct SideBySide {
  std::size_t lanes;
  std::vector<Filter> filters;
  std::vector<double> held, t_s, gyro_dps, columns[5];
  std::size_t first, taken = 0;

  SideBySide(const HoldKernel& kernel, const std::vector<double>& intervals_s, std::size_t from,
             std::size_t samples)
      : lanes(intervals_s.size()), held(held_numbers * lanes), first(from) {
    for (std::size_t l = 0; l < lanes; ++l) {
      filters.push_back(filter_with(intervals_s[l]));
      for (std::size_t k = 0; k < first; ++k) filters[l].step(sample(l, k));
      const auto at = *filters[l].held();
      const double numbers[] = {at.from_s,           at.least_s,         at.last_s,
                                at.turned_deg,       at.compensated_dps, at.estimate_dps,
                                at.estimate_variance};
      for (std::size_t i = 0; i < held_numbers; ++i) held[i * lanes + l] = numbers[i];
    }
    for (std::size_t k = first; k < first + samples; ++k)
      for (std::size_t l = 0; l < lanes; ++l) {
        t_s.push_back(sample(l, k).t_s);
        gyro_dps.push_back(sample(l, k).gyro_dps);
      }
    for (auto& column : columns) column.assign(lanes * samples, -1.0);
    taken = kernel.run(held.data(), t_s.data(), gyro_dps.data(),
                       {columns[0].data(), columns[1].data(), columns[2].data(), columns[3].data(),
                        columns[4].data()},
                       samples);
  }
};

std::vector<const HoldKernel*> kernels() {
  std::vector<const HoldKernel*> found;
  for (const int lanes : {2, 4, 8, 16})
    if (const auto* kernel = hold_kernel(lanes)) found.push_back(kernel);
  return found;
}

/// From sample 237 on, in the third interval of ten seconds, up to the epoch at 300.
TEST(HoldKernel, TakesSamplesAsTheFilterDoesUpToTheNextEpoch) {
  for (const auto* kernel : kernels()) {
    const auto lanes = static_cast<std::size_t>(kernel->lanes);
    SideBySide trials(*kernel, std::vector<double>(lanes, 10.0), 237, 100);
    ASSERT_EQ(trials.taken, 63U);
    for (std::size_t l = 0; l < lanes; ++l) {
      auto& filter = trials.filters[l];
      for (std::size_t k = 0; k < trials.taken; ++k) {
        const auto step = filter.step(sample(l, 237 + k));
        const double expected[] = {step.estimate_dps, step.estimate_variance, step.innovation_dps,
                                   step.innovation_variance, static_cast<double>(step.status)};
        for (std::size_t c = 0; c < 5; ++c)
          ASSERT_EQ(bits(trials.columns[c][k * lanes + l]), bits(expected[c])) << c << ", " << k;
      }
      const auto held = *filter.held();
      EXPECT_EQ(bits(trials.held[2 * lanes + l]), bits(held.last_s));
      EXPECT_EQ(bits(trials.held[3 * lanes + l]), bits(held.turned_deg));
      EXPECT_EQ(trials.columns[0][trials.taken * lanes + l], -1.0);
    }
  }
}

TEST(HoldKernel, EndsAtTheFirstEpochOfAnyLane) {
  for (const auto* kernel : kernels()) {
    std::vector<double> intervals_s(static_cast<std::size_t>(kernel->lanes), 10.0);
    intervals_s.back() = 4.0;  // its epochs are at 200, 240, ...
    EXPECT_EQ(SideBySide(*kernel, intervals_s, 237, 100).taken, 3U);
  }
}

TEST(HoldKernel, TakesNoneBeforeTheFirstSample) {
  for (const auto* kernel : kernels()) {
    const std::vector<double> intervals_s(static_cast<std::size_t>(kernel->lanes), 10.0);
    EXPECT_EQ(SideBySide(*kernel, intervals_s, 0, 10).taken, 0U);
  }
}

/// What resumes from the numbers of the kernel goes on with the same bits.
TEST(HoldKernel, LeavesWhatTheFilterGoesOnFrom) {
  for (const auto* kernel : kernels()) {
    const auto lanes = static_cast<std::size_t>(kernel->lanes);
    SideBySide trials(*kernel, std::vector<double>(lanes, 10.0), 237, 100);
    for (std::size_t l = 0; l < lanes; ++l) {
      auto alone = trials.filters[l], resumed = alone;
      for (std::size_t k = 237; k < 300; ++k) alone.step(sample(l, k));
      resumed.resume(
          {.last_s = trials.held[2 * lanes + l], .turned_deg = trials.held[3 * lanes + l]});
      const auto expected = alone.step(sample(l, 300)), found = resumed.step(sample(l, 300));
      EXPECT_EQ(expected.status, Status::ok);
      EXPECT_EQ(bits(found.estimate_dps), bits(expected.estimate_dps));
      EXPECT_EQ(bits(found.innovation_dps), bits(expected.innovation_dps));
    }
  }
}

TEST(HoldKernel, IsNotForFiltersThatFollowTheTemperature) {
  EXPECT_TRUE(filter_with(10.0).held());
  EXPECT_FALSE(filter_with(10.0, 1.0).held());
}

}  // namespace
}  // namespace gyrostat::held_test
