#include <gyrostat/analysis/innovations.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace gyrostat::innovations_test {
namespace {

Track track_of(const std::vector<double>& innovations, double variance) {
  Track track;
  track.resize(innovations.size());
  track.innovation_dps = innovations;
  track.innovation_variance.assign(innovations.size(), variance);
  return track;
}

/// By hand: z = 1, -1, 3, -3 with a missing sample between.
TEST(Innovations, AreWhatTheirDefinitionsSay) {
  const auto result = innovation_statistics(track_of({2.0, -2.0, no_value, 6.0, -6.0}, 4.0));
  EXPECT_EQ(result.count, 4U);
  EXPECT_DOUBLE_EQ(result.nis, 5.0);
  EXPECT_DOUBLE_EQ(result.log_score, 0.5 * (std::log(8.0 * std::acos(-1.0)) + 5.0));
  // Of the normal distribution 0.841 lies below 1 and 0.9987 below 3.
  EXPECT_DOUBLE_EQ(result.pit[0], 0.25);
  EXPECT_DOUBLE_EQ(result.pit[1], 0.25);
  EXPECT_DOUBLE_EQ(result.pit[8], 0.25);
  EXPECT_DOUBLE_EQ(result.pit[9], 0.25);
  EXPECT_TRUE(std::isnan(result.ljung_box)) << "four values have no correlation at lag ten";
}

TEST(Innovations, AutocorrelationsAreThoseOfTheDefinition) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> values(200);
  for (double& v : values) v = normal(random);
  const auto result = innovation_statistics(track_of(values, 1.0));
  double squares = 0.0, q = 0.0;
  for (const double v : values) squares += v * v;
  for (std::size_t lag = 1; lag <= 10; ++lag) {
    double products = 0.0;
    for (std::size_t i = lag; i < values.size(); ++i) products += values[i] * values[i - lag];
    const double r = products / squares;
    if (lag == 1) {
      EXPECT_NEAR(result.lag_1, r, 1e-12);
    }
    q += 200.0 * 202.0 * r * r / (200.0 - static_cast<double>(lag));
  }
  EXPECT_NEAR(result.ljung_box, q, 1e-10);
}

/// A tenth of white noise in each bin, to five standard errors of a multinomial count.
TEST(Innovations, WhiteNoiseFillsTheHistogramEvenly) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::vector<double> values(100000);
  for (double& v : values) v = 3.0 * normal(random);
  const auto result = innovation_statistics(track_of(values, 9.0));
  for (const double share : result.pit) EXPECT_NEAR(share, 0.1, 5.0 * std::sqrt(0.09 / 100000.0));
}

TEST(Innovations, OfAFilterWithoutAnyHaveNoValues) {
  const auto result = innovation_statistics(track_of(std::vector<double>(50, no_value), 1.0));
  EXPECT_EQ(result.count, 0U);
  EXPECT_TRUE(std::isnan(result.nis));
  EXPECT_TRUE(std::isnan(result.lag_1));
  EXPECT_TRUE(std::isnan(result.pit[0]));
}

}  // namespace
}  // namespace gyrostat::innovations_test
