// Innovations about a level that walks: against the mean, and against what was put in.

#include <gyrostat/diagnosis/likelihood/walking_level.hpp>

#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap::walking_level_test {
namespace {

std::vector<double> about_a_walk(double step, std::size_t count) {
  const NormalStream noise(1, 0, "noise"), steps(1, 0, "steps");
  std::vector<double> values;
  double level = 7.0;
  for (std::size_t i = 0; i < count; ++i) {
    level += step * steps.normal(i);
    values.push_back(level + noise.normal(i));
  }
  return values;
}

TEST(WalkingLevel, ThatStandsStillLeavesTheSquaresAboutTheMean) {
  const auto values = about_a_walk(0.0, 200);
  WalkingLevel level(0.0);
  double mean = 0.0, squares = 0.0, innovations = 0.0;
  for (const double v : values) mean += v / 200.0;
  for (const double v : values) {
    squares += (v - mean) * (v - mean);
    const double innovation = level.innovation(v);
    innovations += innovation * innovation;
  }
  EXPECT_NEAR(innovations, squares, 1e-9);
}

/// Of a walk with steps of q times the noise the steady gain k solves q^2 (1 - k) = k^2. Squares of
/// white innovations in units of the noise have a mean of 1 and a standard error of sqrt(2 / n):
/// five of these are missed once in two million families.
TEST(WalkingLevel, OfTheWalksOwnGainLeavesTheWhiteNoise) {
  constexpr std::size_t count = 20000;
  constexpr double q = 0.1;
  const double gain = 0.5 * q * (std::sqrt(q * q + 4.0) - q);
  const auto values = about_a_walk(q, count);
  const auto variance_at = [&](double at, double& log_likelihood) {
    WalkingLevel level(at);
    double squares = 0.0;
    for (const double v : values) {
      const double innovation = level.innovation(v);
      squares += innovation * innovation;
    }
    const double variance = squares / static_cast<double>(count);
    log_likelihood =
        -0.5 * static_cast<double>(count) * std::log(variance) + 0.5 * level.log_known();
    return variance;
  };
  double best = 0.0, other = 0.0;
  EXPECT_NEAR(variance_at(gain, best), 1.0, 5.0 * std::sqrt(2.0 / count));
  for (const double wrong : {0.0, 0.3 * gain, 3.0 * gain}) {
    variance_at(wrong, other);
    EXPECT_LT(other, best) << wrong;
  }
}

}  // namespace
}  // namespace gyrostat::gap::walking_level_test
