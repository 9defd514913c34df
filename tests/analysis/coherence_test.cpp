#include <gyrostat/analysis/spectra/coherence.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat::coherence_test {
namespace {

constexpr std::size_t length = 64, segments = 16;

std::vector<double> noise(std::uint32_t trial, const char* name, double std = 1.0) {
  std::vector<double> values(length * segments);
  NormalStream(31, trial, name).fill(0, values);
  for (auto& v : values) v *= std;
  return values;
}

/// A tone in independent noise is coherent by chance as the law says: of 4000 pairs the share below
/// p has the standard error sqrt(p (1 - p) / 4000); each bound is five of them, which fails once
/// in 1.7 million.
TEST(Coherence, ByChanceIsAsRareAsItsLawSays) {
  constexpr int pairs = 4000;
  for (const double p : {0.5, 0.05, 0.01}) {
    int below = 0;
    for (std::uint32_t trial = 0; trial < pairs; ++trial) {
      auto x = noise(trial, "x");
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] += 3.0 * std::sin(2.0 * std::numbers::pi * 0.2 * static_cast<double>(k));
      below += chance_of(coherence(x, noise(trial, "y"), 0.2, length)) < p;
    }
    EXPECT_NEAR(below / double{pairs}, p, 5.0 * std::sqrt(p * (1.0 - p) / pairs));
  }
}

/// y = 2 x + noise of three times x's strength has the coherence 4 / (4 + 9) at every frequency; by
/// Carter, Knapp and Nuttall its estimate is too large by (1 - c)^2 / n. Over 1000 trials its mean
/// has a standard error of 0.0043 or less, and five of these are allowed.
TEST(Coherence, IsTheShareOfPowerThatIsALinearResponse) {
  constexpr int trials = 1000;
  double mean = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto x = noise(trial, "x");
    auto y = noise(trial, "y", 3.0);
    for (std::size_t k = 0; k < x.size(); ++k) y[k] += 2.0 * x[k];
    mean += coherence(x, y, 0.3, length).squared / trials;
  }
  constexpr double c = 4.0 / 13.0;
  EXPECT_NEAR(mean, c + (1.0 - c) * (1.0 - c) / segments, 5.0 * 0.0043);
}

TEST(Coherence, PassesOverWhatIsMissingAndNeedsTwoSegments) {
  const auto x = noise(0, "x");
  auto y = x;
  y[3] = y[2 * length] = no_value;
  EXPECT_EQ(coherence(x, y, 0.1, length).segments, segments - 2);
  EXPECT_NEAR(coherence(x, y, 0.1, length).squared, 1.0, 1e-12);
  EXPECT_EQ(chance_of(coherence({x.data(), length}, {x.data(), length}, 0.1, length)), 1.0);
  EXPECT_EQ(coherence({}, {}, 0.1, length).squared, 0.0);
}

}  // namespace
}  // namespace gyrostat::coherence_test
