// Times as recordings have them: dropped samples, stamps of arrival, rates that change.

#include <gyrostat/recordings/clock.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat::clock_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Uniform in [0, 1), the same everywhere.
struct Uniform {
  std::uint64_t state = 7;
  double operator()() {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  }
};

Series at_times(const std::vector<double>& t_s) {
  Series series;
  series.t_s = t_s;
  for (std::size_t i = 0; i < t_s.size(); ++i) series.gyro_dps.push_back(static_cast<double>(i));
  return series;
}

TEST(Clock, WhatIsEvenStaysAsItIs) {
  std::vector<double> t;
  Uniform uniform;
  for (int i = 0; i < 1000; ++i) t.push_back(0.01 * i + 0.0004 * uniform());
  const auto even = evenly_sampled(at_times(t), "x");
  EXPECT_EQ(even.series.t_s, t);
  EXPECT_THAT(even.note, IsEmpty());
}

TEST(Clock, DroppedSamplesBecomeMissing) {
  std::vector<double> t;
  Series series;
  for (int i = 0; i < 1000; ++i) {
    if (i == 100 || (i >= 500 && i < 540)) continue;
    series.t_s.push_back(5 + 0.01 * i);
    series.gyro_dps.push_back(i);
    series.temperature_C.push_back(20 + 0.1 * i);
  }
  const auto even = evenly_sampled(series, "x");
  ASSERT_EQ(even.series.size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i) {
    const auto at = static_cast<double>(i);
    EXPECT_NEAR(even.series.t_s[i], 5 + 0.01 * at, 1e-9);
    if (i == 100 || (i >= 500 && i < 540))
      EXPECT_TRUE(std::isnan(even.series.gyro_dps[i]));
    else
      EXPECT_EQ(even.series.gyro_dps[i], at);
    EXPECT_NEAR(even.series.temperature_C[i], 20 + 0.1 * at, 1e-9);
  }
  EXPECT_THAT(even.note, AllOf(HasSubstr("41 of 1000 samples"), HasSubstr("100 Hz")));
}

TEST(Clock, StampsOfArrivalAreReplacedByTheNominalClock) {
  // Sampled at 100 Hz, handed over in bursts.
  std::vector<double> t;
  Uniform uniform;
  for (int i = 0; i < 20000;) {
    const int burst = 1 + static_cast<int>(12 * uniform());
    const double arrives = 0.01 * (i + burst) + 0.003 * uniform();
    for (int k = 0; k < burst; ++k, ++i) t.push_back(arrives + 1e-4 * k);
  }
  for (std::size_t i = 1; i < t.size(); ++i) t[i] = std::max(t[i], t[i - 1] + 1e-5);
  const auto even = evenly_sampled(at_times(t), "x");
  ASSERT_EQ(even.series.size(), t.size());
  EXPECT_TRUE(is_even(even.series.t_s));
  EXPECT_NEAR(even.series.rate_hz(), 100, 1e-3);
  EXPECT_THAT(even.note, AllOf(HasSubstr("stamps are not"), HasSubstr("ms rms")));
}

TEST(Clock, ARateThatChangesIsRefusedWithTheRemedy) {
  std::vector<double> t = {0};
  Uniform uniform;
  for (int i = 1; i < 5000; ++i) t.push_back(t.back() + (uniform() < 0.3 ? 0.0147 : 0.01));
  try {
    evenly_sampled(at_times(t), "x.csv");
    FAIL();
  } catch (const InputError& mistake) {
    EXPECT_THAT(mistake.what(), AllOf(HasSubstr("x.csv:"), HasSubstr("--resample 100")));
  }
  const auto even = evenly_sampled(at_times(t), "x.csv", 2, 100);
  EXPECT_TRUE(is_even(even.series.t_s));
  EXPECT_NEAR(even.series.duration_s(), t.back() - t.front(), 0.01);
  EXPECT_THAT(even.note, HasSubstr("have no sample"));
}

TEST(Clock, ATickHasTheMeanOfItsSamples) {
  Series series;
  for (int i = 0; i < 400; ++i) {
    series.t_s.push_back(0.0025 * i);
    series.gyro_dps.push_back(i % 2 == 0 ? 1.0 : 3.0);
  }
  const auto even = evenly_sampled(series, "x", 2, 20);  // twenty samples a tick
  for (std::size_t i = 1; i + 1 < even.series.size(); ++i)
    EXPECT_NEAR(even.series.gyro_dps[i], 2.0, 0.06);
  EXPECT_NEAR(even.series.rate_hz(), 20, 1e-9);
}

TEST(Clock, LostSamplesAreNotTakenForStampsOfArrival) {
  // Half of the samples lost, in runs: no line over their number holds.
  std::vector<double> t;
  Uniform uniform;
  for (int i = 0; i < 20000; ++i) {
    t.push_back(0.01 * i + 0.0045 * uniform());
    if (uniform() < 0.05) i += static_cast<int>(40 * uniform());
  }
  try {
    const auto even = evenly_sampled(at_times(t), "x");
    EXPECT_THAT(even.note, HasSubstr("missing"));
  } catch (const InputError& mistake) {
    EXPECT_THAT(mistake.what(), HasSubstr("--resample"));
  }
}

TEST(Clock, OfBurstsTheLongestIsNamed) {
  std::vector<double> t;
  for (const int at : {0, 3000, 6000})
    for (int i = 0; i < (at == 3000 ? 250 : 240); ++i) t.push_back(0.02 * (at + i));
  const auto bursts = evenly_sampled(at_times(t), "x").series;
  try {
    require_dense(bursts, "x", 100.0);
    FAIL();
  } catch (const InputError& mistake) {
    EXPECT_THAT(mistake.what(),
                AllOf(HasSubstr("is 3 bursts at 50 Hz"), HasSubstr("250 samples, from 160 to 165"),
                      Not(HasSubstr("--resample"))));
  }
}

}  // namespace
}  // namespace gyrostat::clock_test
