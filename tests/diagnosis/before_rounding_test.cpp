#include <gyrostat/diagnosis/likelihood/before_rounding.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::before_rounding_test {
namespace {

constexpr double lsb = 3.0;
constexpr double decay = 0.6;  // of noise of unit variance, from sample to sample

std::vector<double> decaying_noise(std::size_t size, double level) {
  const NormalStream noise(5, 0, "noise");
  std::vector<double> values;
  double value = noise.normal(size);
  for (std::size_t i = 0; i < size; ++i) {
    value = decay * value + std::sqrt(1.0 - decay * decay) * noise.normal(i);
    values.push_back(level + value);
  }
  return values;
}

std::vector<double> rounded(std::vector<double> values) {
  for (double& value : values) value = lsb * std::nearbyint(value / lsb);
  return values;
}

const NoiseAboutLevel true_law{
    .coefficients = {-decay}, .innovation = 1.0 - decay * decay, .walk = 0.0};

/// What is far off, as a gross error, is no draw's, nor is what says nothing.
TEST(BeforeRounding, DrawsLieInTheirCells) {
  auto values = rounded(decaying_noise(2000, 1.2));
  values[100] = no_value;
  values[200] = 50.0 * lsb;
  std::vector<char> unknown(values.size(), 0);
  unknown[300] = 1;
  const std::vector<double> known(values.size(), 0.0);
  BeforeRounding before(values, unknown, lsb);
  before.draw(true_law, known, 3);
  const auto& drawn = before.rate_dps();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_drawn = i != 100 && i != 200 && i != 300;
    if (is_drawn) {
      EXPECT_LE(std::abs(drawn[i] - values[i]), 0.5 * lsb) << i;
    }
  }
  EXPECT_TRUE(is_missing(drawn[100]));
  for (const std::size_t i : {200, 300}) EXPECT_EQ(drawn[i], values[i]);
  BeforeRounding again(values, unknown, lsb);
  again.draw(true_law, known, 3);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i != 100) {
      EXPECT_EQ(drawn[i], again.rate_dps()[i]);
    }
}

/// What is cut off towards zero comes there from both sides.
TEST(BeforeRounding, TheCellAtZeroIsTwiceAsWideWhereValuesAreCutOff) {
  // Half a step beside zero, which `middles_of_cut_off` makes of a zero, is the same cell.
  for (const double middle : {0.0, 0.5 * lsb}) {
    const std::vector<double> values(2000, middle), known(values.size(), 0.0);
    BeforeRounding before(values, std::vector<char>(values.size(), 0), lsb,
                          BeforeRounding::Cells::twice_as_wide_at_zero);
    before.draw({.coefficients = {}, .innovation = lsb * lsb, .walk = 0.0}, known, 3);
    const auto [least, most] =
        std::minmax_element(before.rate_dps().begin(), before.rate_dps().end());
    EXPECT_GT(*most, 0.9 * lsb);
    EXPECT_LE(*most, lsb);
    EXPECT_LT(*least, -0.9 * lsb);
    EXPECT_GE(*least, -lsb);
  }
}

/// Draws from the law that the noise has, given what it was rounded to, have on average the noise's
/// covariance, and each differs from it by no more than noise does: the standard error is
/// Bartlett's for this noise, sqrt((1 + d^2) / (1 - d^2) 2 / n) at all lags at the most. Five of
/// these, three times, are missed once in half a million.
TEST(BeforeRounding, DrawsHaveTheCovarianceThatRoundingTookAway) {
  constexpr std::size_t size = 20000;
  const auto noise = decaying_noise(size, 0.4 * lsb);
  const auto values = rounded(noise);
  BeforeRounding before(values, std::vector<char>(size, 0), lsb);
  const std::vector<double> known(size, 0.0);
  before.draw(true_law, known, 100);
  constexpr int draws = 20;
  std::vector<double> covariance(3, 0.0), of_rounded(3, 0.0);
  const auto add = [&](const std::vector<double>& of, double weight, std::vector<double>& to) {
    double mean = 0.0;
    for (const double v : of) mean += v / static_cast<double>(size);
    for (std::size_t lag = 0; lag < to.size(); ++lag)
      for (std::size_t i = lag; i < size; ++i)
        to[lag] += weight * (of[i] - mean) * (of[i - lag] - mean) / static_cast<double>(size);
  };
  for (int k = 0; k < draws; ++k) {
    before.draw(true_law, known, 5);
    add(before.rate_dps(), 1.0 / draws, covariance);
  }
  add(values, 1.0, of_rounded);
  const double d2 = decay * decay;
  const double error = std::sqrt((1.0 + d2) / (1.0 - d2) * 2.0 / static_cast<double>(size));
  for (std::size_t lag = 0; lag < covariance.size(); ++lag) {
    const double truth = std::pow(decay, static_cast<double>(lag));
    EXPECT_NEAR(covariance[lag], truth, 5.0 * error) << lag;
    EXPECT_GT(std::abs(of_rounded[lag] - truth), 5.0 * error) << lag;  // the test can tell
  }
}

/// White noise through one pole of a share a is an autoregression of order one. A Gauss-Markov
/// error stands out from white noise up to where its density has fallen to it, and a walk with that
/// density there stands for it.
TEST(BeforeRounding, ALawIsAnAutoregressionAboutAWalk) {
  const Angles angles(513);
  const double interval_s = 0.05;
  NoiseLaw law{.interval_s = interval_s, .white = 1.0, .walk = 4e-4};
  law.filter = effects::NoiseBandwidth{.cutoff_hz = 2.0};
  law.rounding = 7.0;
  const double share = -std::expm1(-2.0 * std::numbers::pi * 2.0 * interval_s);
  const auto filtered = noise_about_level(law, angles, 0.4);
  ASSERT_GE(filtered.coefficients.size(), 1U);
  EXPECT_NEAR(filtered.coefficients[0], share - 1.0, 1e-3);
  EXPECT_NEAR(filtered.innovation, share * share, 1e-3 * share * share);

  NoiseLaw slow{.interval_s = interval_s, .white = 1.0};
  slow.decaying = {{0.09, 15.0}};
  const auto found = noise_about_level(slow, angles, 0.4);
  const double d = std::exp(-interval_s / 15.0);
  // v (1 - d^2) / ((1 - d)^2 + d c) = 1 at the chord c.
  const double chord = (0.09 * (1.0 - d * d) - (1.0 - d) * (1.0 - d)) / d;
  EXPECT_NEAR(found.walk, chord, 0.1 * chord);
  EXPECT_NEAR(found.innovation, 1.0, 1e-6);
}

TEST(SetSearch, WhiteNoiseBelowACoarseGridHasNoOtherEffect) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effects::Quantization{0.17}};
  EXPECT_EQ(found_in(recorded(s, 96, false)), std::set<std::string>{"quantization"});
}

/// The grid has 3.6 deviations of what passes the filter, which was never found on such. On a table
/// nothing dithers it but the turns, of which a shift leaves samples of 60 dps: a scale of .28,
/// limits, steps and outliers stood there, at p = 6e-10.
TEST(SetSearch, AShiftAndAFilterAreFoundBesideAGridCoarserThanTheNoise) {
  Scenario s = still(0.5 * ten_minutes_s);
  s.motion = motion::RateTable{60.0, 24.0};
  s.effects = {effects::TimeOffset{.offset_s = 0.05}, effects::ScaleAsymmetry{.error = 0.005},
               effects::NoiseBandwidth{.cutoff_hz = 2.0}, effects::Quantization{0.1}};
  EXPECT_EQ(
      found_in(recorded(s, 97, true)),
      (std::set<std::string>{"noise_bandwidth", "quantization", "scale_asymmetry", "time_offset"}));
}

}  // namespace
}  // namespace gyrostat::gap::before_rounding_test
