// What happens once, in noise of any spectrum and size.

#include <gyrostat/diagnosis/likelihood/transient.hpp>

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap::transient_test {
namespace {

constexpr double rate_hz = 120.0;
constexpr std::size_t samples = 14'400;

/// Normal noise of deviation 1 that remembers a third of the sample before, times its size over
/// time.
Series noise(std::uint64_t seed, const std::function<double(double t_s)>& size) {
  const NormalStream normal(seed, 0, "white");
  Series series;
  double value = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double t_s = static_cast<double>(i) / rate_hz;
    value = std::sqrt(8.0) / 3.0 * normal.normal(i) + value / 3.0;
    series.t_s.push_back(t_s);
    series.gyro_dps.push_back(size(t_s) * value);
  }
  return series;
}

double even(double) { return 1.0; }

std::optional<Transient> transient_of(const Series& series,
                                      const std::vector<Resonance>& lines = {}) {
  return clearest_transient(Conditions(series), Part::train, series.gyro_dps, lines);
}

/// A resonance that is struck at 70 s and decays within 0.15 s.
void knock(Series& series, double amplitude_dps, double frequency_hz) {
  for (std::size_t i = 0; i < samples; ++i)
    if (const double since_s = series.t_s[i] - 70.0; since_s >= 0.0)
      series.gyro_dps[i] += amplitude_dps * std::exp(-since_s / 0.15) *
                            std::sin(2.0 * std::numbers::pi * frequency_hz * since_s);
}

/// Of 200 recordings p is below .1 in 20 or fewer, and in more than 36 once in 5,000 such tests
/// (binomial, .0002). It is a bound, tiles that overlap counting each: below .5 it has been in 20
/// to 35 of them, and is in fewer than 6 once in 1,000 where 20 are expected.
TEST(Transient, ItsPValueIsNoSmallerThanChanceHasIt) {
  const auto rises = [](double t_s) { return 1.0 + 2.0 * t_s / 120.0; };
  const auto heaves = [](double t_s) {
    return 1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * t_s / 20.0);
  };
  for (const std::function<double(double)>& size : {std::function(even), {rises}, {heaves}}) {
    int below_a_tenth = 0, below_half = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const double p = transient_of(noise(seed, size))->p_value;
      below_a_tenth += p < 0.1;
      below_half += p < 0.5;
    }
    EXPECT_LE(below_a_tenth, 36);
    EXPECT_GE(below_half, 6);
  }
}

/// Eight deviations that decay within 18 samples have 8^2 / 2 x 9 = 288 times the variance of a
/// sample: half of it over the spectrum, 126 at 20 Hz, would be the exponent of a filter that is
/// matched to it, and two fifths of that is in a tile.
TEST(Transient, AKnockIsFoundWhereAndWhenItIs) {
  for (const double frequency_hz : {20.0, 54.5}) {
    auto series = noise(5, even);
    knock(series, 8.0, frequency_hz);
    const auto found = transient_of(series);
    ASSERT_TRUE(found);
    EXPECT_LT(found->p_value, 1e-6);
    EXPECT_LT(found->from_s, 70.2);
    EXPECT_GT(found->to_s, 70.0);
    EXPECT_LT(found->to_s - found->from_s, 1.1);
    EXPECT_NEAR(found->frequency_hz, frequency_hz, 4.0);
  }
}

TEST(Transient, ASpikeOrAStepOrALineIsNone) {
  auto spiked = noise(6, even);
  spiked.gyro_dps[8'000] += 20.0;
  EXPECT_GT(transient_of(spiked)->p_value, 0.01);
  auto stepped = noise(6, even);
  for (std::size_t i = 8'000; i < samples; ++i) stepped.gyro_dps[i] += 20.0;
  EXPECT_GT(transient_of(stepped)->p_value, 0.01);
  auto with_line = noise(7, even);
  for (std::size_t i = 0; i < samples; ++i)
    with_line.gyro_dps[i] += 3.0 * std::sin(2.0 * std::numbers::pi * 20.0 * with_line.t_s[i]);
  EXPECT_GT(transient_of(with_line)->p_value, 0.01);
}

/// What comes and goes in a band that has a name has that name.
TEST(Transient, IsNotLookedForInTheBandOfALineNorOfAMotion) {
  auto series = noise(5, even);
  knock(series, 8.0, 20.0);
  EXPECT_GT(transient_of(series, {{1.0, 20.0, 4.0}})->p_value, 0.01);
  auto tilted = series, turned = series;
  for (std::size_t i = 0; i < samples; ++i) {
    tilted.acc_x_mps2.push_back(i < samples / 2 ? 0.0 : 0.6);
    turned.cross_rate_1_dps.push_back(i < samples / 2 ? 0.0 : 6.0);
  }
  EXPECT_FALSE(transient_of(tilted));
  EXPECT_FALSE(transient_of(turned));
  series.rate_ref_dps.assign(samples, 0.0);
  series.rate_ref_dps[100] = 1.0;
  EXPECT_FALSE(transient_of(series));
}

}  // namespace
}  // namespace gyrostat::gap::transient_test
