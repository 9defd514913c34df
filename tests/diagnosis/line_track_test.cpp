// A line that is followed from block to block.

#include <gyrostat/diagnosis/likelihood/line_track.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/bessel.hpp>
#include <gtest/gtest.h>

#include <gyrostat/diagnosis/likelihood/frequency_track.hpp>
#include <gyrostat/diagnosis/likelihood/line_shape.hpp>
#include <gyrostat/generators/effects/vibration.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::line_track_test {
namespace {

/// Three half bins, three blocks: the sum over all 27 tracks, written out.
TEST(FrequencyTrack, IsTheSumOverAllTracks) {
  BlockPowers blocks{.length = 64, .first = 4, .resolution_hz = 1.0, .interval_s = 1.0};
  blocks.noise_dps2 = {1.0, 1.0};
  blocks.spans = {{{5.0, 0.4}, {2.0, 3.0}, {0.3, 7.0}}};
  const std::vector<double> power = {4.0, 5.0};
  const Wandering wandering{.centre_hz = 4.6, .std_hz = 0.5, .memory_blocks = 2.0};
  const FrequencyTrack track(blocks, wandering);

  const auto bell = [](double x, double std) { return std::exp(-0.5 * x * x / (std * std)); };
  const auto hz = [](int state) { return 4.0 + 0.5 * state; };
  const auto ratio = [&](int state, const std::vector<double>& seen) {
    const double half = 4.0 / (std::numbers::pi * std::numbers::pi);
    const auto of = [](double q, double a) {
      return boost::math::cyl_bessel_i(0, 2.0 * std::sqrt(q * a)) * std::exp(-a);
    };
    if (state == 0) return of(seen[0], power[0]);
    if (state == 2) return of(seen[1], power[1]);
    return of(seen[0], half * power[0]) * of(seen[1], half * power[1]);
  };
  const double width = 0.3, stay = std::exp(-0.5);
  const auto chance_of = [&](double mean_hz, double std_hz, int state) {
    double sum = 0.0;
    for (int s = 0; s < 3; ++s) sum += bell(hz(s) - mean_hz, std_hz);
    return bell(hz(state) - mean_hz, std_hz) / sum;
  };
  const double first = std::hypot(0.5, width);
  const double step = std::hypot(0.5 * std::sqrt(1.0 - stay * stay), width);
  const auto next = [&](int from, int to) {
    return chance_of(4.6 + stay * (hz(from) - 4.6), step, to);
  };
  double sum = 0.0, mean = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) {
        const auto& seen = blocks.spans[0];
        const double likelihood = chance_of(4.6, first, a) * ratio(a, seen[0]) * next(a, b) *
                                  ratio(b, seen[1]) * next(b, c) * ratio(c, seen[2]);
        sum += likelihood;
        mean += likelihood * (hz(a) + hz(b) + hz(c)) / 3.0;
      }
  constexpr double exact = 12 * 5e-7;  // of so many Bessel functions, each within 5e-7
  EXPECT_NEAR(track.log_gain(power), std::log(sum), exact);
  EXPECT_NEAR(track.seen(power).centre_hz, mean / sum, exact);
}

/// Over all that noise may show, a likelihood ratio is 1 on average: here of one block, by the
/// integral over both of its bins.
TEST(FrequencyTrack, IsALikelihood) {
  BlockPowers blocks{.length = 64, .first = 4, .resolution_hz = 1.0, .interval_s = 1.0};
  blocks.noise_dps2 = {1.0, 1.0};
  const Wandering wandering{.centre_hz = 4.3, .std_hz = 0.5, .memory_blocks = 2.0};
  double sum = 0.0;
  constexpr double step = 0.1;
  for (double a = 0.5 * step; a < 40.0; a += step)
    for (double b = 0.5 * step; b < 40.0; b += step) {
      blocks.spans = {{{a, b}}};
      sum += step * step * std::exp(FrequencyTrack(blocks, wandering).log_gain({2.0, 2.0}) - a - b);
    }
  EXPECT_NEAR(sum, 1.0, 2e-3);
}

/// The clearest of what 1200 s at 20 Hz hold: white noise of 0.05 dps and a line of 0.02 about
/// 6 Hz, of which no spectrum tells whether it is a sine.
constexpr double noise_dps = 0.05, amplitude_dps = 0.02;
constexpr int draws = 40;
constexpr double clear = 4.0;

template <class Line>
double over_band(const Line& line, int seed) {
  Series series;
  const NormalStream noise(static_cast<std::uint64_t>(seed), 0, "white");
  for (std::size_t i = 0; i < 24000; ++i) {
    series.t_s.push_back(0.05 * static_cast<double>(i));
    series.gyro_dps.push_back(noise_dps * noise.normal(i));
  }
  line.apply(series, {static_cast<std::uint64_t>(seed), 0});
  const NoiseLaw white{.interval_s = 0.05, .duration_s = 1200.0, .white = noise_dps * noise_dps};
  return track_in_band(Conditions(series), series.gyro_dps, white,
                       {0.5 * amplitude_dps * amplitude_dps, 6.0, 1.2})
      .over_band;
}

/// A likelihood ratio above exp(4) has under noise a chance of exp(-4) at most, of each of some
/// twenty forms that are hardly independent: of 40 draws, more than three are expected in one test
/// of 25 if two forms were independent, seldomer else.
TEST(LineTrack, NoiseOfABandIsNoLine) {
  int called = 0;
  for (int k = 0; k < draws; ++k)
    called +=
        over_band(effects::Vibration{amplitude_dps / std::numbers::sqrt2, 6.0, 1.2}, k) > clear;
  EXPECT_LE(called, 3);
}

/// Where a band lies by zero or by half the rate, too, white noise has the envelope of noise. Two
/// forms of three blocks have a chance of some exp(-4) each to be clear, and are hardly
/// independent: of 30 draws one is expected, more than five once in 1,700 tests.
TEST(LineShape, NoiseIsNoBurstsWhereverItsBandLies) {
  int called = 0;
  for (int k = 0; k < 10; ++k) {
    Series series;
    const NormalStream noise(static_cast<std::uint64_t>(k), 0, "white");
    for (std::size_t i = 0; i < 24000; ++i) {
      series.t_s.push_back(0.05 * static_cast<double>(i));
      series.gyro_dps.push_back(noise_dps * noise.normal(i));
    }
    const Conditions conditions(series);
    for (const double centre_hz : {0.54, 5.0, 9.7}) {
      const auto shape = line_shape(conditions, series.gyro_dps, {4e-5, centre_hz, 0.27});
      called += std::max(shape.bursts, shape.wandering) > clear ? 1 : 0;
    }
  }
  EXPECT_LE(called, 5);
}

/// The line has 24000 * 0.75 * 0.02^2 / (4 * 0.05^2) = 720 nats, were its track known.
TEST(LineTrack, ALineFarBelowTheNoiseIsFollowed) {
  int called = 0;
  for (int k = 0; k < draws; ++k)
    called += over_band(effects::WanderingLine{amplitude_dps, 6.0, 0.6, 60.0}, k) > clear;
  EXPECT_EQ(called, draws);
}

/// And found where nobody says where it is; in noise alone none is.
TEST(LineTrack, ALineIsFoundAnywhere) {
  constexpr double least = 15.0;
  for (const double amplitude : {0.0, 0.02}) {
    Series series;
    const NormalStream noise(7, 0, "white");
    for (std::size_t i = 0; i < 24000; ++i) {
      series.t_s.push_back(0.05 * static_cast<double>(i));
      series.gyro_dps.push_back(noise_dps * noise.normal(i));
    }
    effects::WanderingLine{amplitude, 6.0, 0.3, 30.0}.apply(series, {7, 0});
    const NoiseLaw white{.interval_s = 0.05, .duration_s = 1200.0, .white = noise_dps * noise_dps};
    const auto band = band_of_hidden_line(Conditions(series), series.gyro_dps, white, least, 10.0);
    ASSERT_EQ(band.has_value(), amplitude > 0.0);
    if (!band) continue;
    EXPECT_NEAR(band->centre_hz, 6.0, 0.3);
    EXPECT_NEAR(std::sqrt(2.0 * band->variance), amplitude, 0.4 * amplitude);
    EXPECT_NEAR(0.5 * band->bandwidth_hz, 0.3, 0.15);
  }
}

}  // namespace
}  // namespace gyrostat::gap::line_track_test
