// What is looked at of a long recording.

#include <gyrostat/diagnosis/views.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::gap::views_test {
namespace {

Series of_samples(std::size_t samples) {
  Series series;
  series.t_s.resize(samples);
  for (std::size_t i = 0; i < samples; ++i) series.t_s[i] = 0.001 * static_cast<double>(i);
  series.gyro_dps = series.t_s;
  return series;
}

TEST(Views, AreOfAllWhereThatIsNotTooMuch) {
  const auto views = views_of(of_samples(most_samples_at_once));
  ASSERT_EQ(views.size(), 1);
  EXPECT_EQ(views[0].first, 0);
  EXPECT_EQ(views[0].count, most_samples_at_once);
  EXPECT_EQ(views[0].mean_of, 1);
}

TEST(Views, CostNoMoreHoweverLongTheRecordingIs) {
  for (const std::size_t samples : {most_samples_at_once + 1, 3 * most_samples_at_once + 17}) {
    const auto series = of_samples(samples);
    std::size_t cost = 0, reached = 0;
    for (const auto& view : views_of(series)) {
      EXPECT_LE(view.first + view.count, samples);
      if (view.mean_of == 1) {
        EXPECT_GE(view.first, reached);
        reached = view.first + view.count;
      }
      cost += looked_at(series, view).size();
    }
    EXPECT_GT(reached, samples / 2);
    EXPECT_LE(cost, most_samples_at_once);
  }
}

TEST(Views, StretchesLieWhereSamplesAre) {
  auto series = of_samples(3 * most_samples_at_once);
  const auto middle = views_of(series)[0];
  for (std::size_t i = middle.first; i < middle.first + middle.count / 2; ++i)
    series.gyro_dps[i] = no_value;
  const auto beside = views_of(series)[0];
  EXPECT_NE(beside.first, middle.first);
  for (std::size_t i = beside.first; i < beside.first + beside.count; ++i)
    ASSERT_FALSE(is_missing(series.gyro_dps[i]));
}

/// A sensor that hangs from before the middle of a quarter to its end; and all the time.
TEST(Views, StretchesLieWhereTheGyroChanges) {
  auto series = of_samples(3 * most_samples_at_once);
  const auto middle = views_of(series)[1];
  for (std::size_t i = middle.first - 10; i < series.size() / 2; ++i) series.gyro_dps[i] = 0.25;
  const auto beside = views_of(series)[1];
  EXPECT_LE(beside.first + beside.count, middle.first);
  EXPECT_FALSE(never_changes(looked_at(series, beside).gyro_dps));
  series.gyro_dps.assign(series.size(), 0.25);
  series.gyro_dps[7] = no_value;
  EXPECT_EQ(views_of(series)[1].first, middle.first);
  EXPECT_TRUE(never_changes(series.gyro_dps));
}

TEST(Views, MeansAreOfWhatIsThere) {
  Series series = of_samples(11);
  series.gyro_dps = {1, 2, no_value, 1, no_value, no_value, no_value, 5, 7, 7, 100};
  series.heading_deg = {179, -179, 179, -179, 10, 20, 30, 40, 0, 0, 0};
  series.mag_valid = {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1};
  const auto means = looked_at(series, {.first = 0, .count = 11, .mean_of = 4});
  ASSERT_EQ(means.size(), 2);
  // sin² of 22.5° and 67.5°: .146 and .854
  EXPECT_NEAR(means.gyro_dps[0], (2 * 0.1464466 + 2 * 0.8535534) / (2 * 0.1464466 + 0.8535534),
              1e-6);
  EXPECT_TRUE(is_missing(means.gyro_dps[1]));
  EXPECT_NEAR(means.t_s[1], 0.0055, 1e-15);
  EXPECT_NEAR(std::abs(means.heading_deg[0]), 180.0, 1e-9);
  EXPECT_NEAR(means.heading_deg[1], 25.0, 1e-9);
  EXPECT_THAT(means.mag_valid, testing::ElementsAre(0.0, 1.0));
  EXPECT_TRUE(means.temperature_C.empty());
}

/// A line at 3.45 times the means' rate is lost, of which plain means keep a tenth; values on a
/// grid have means on none.
TEST(Views, MeansLoseLinesAndGrids) {
  Series series = of_samples(40'000);
  for (std::size_t i = 0; i < series.size(); ++i)
    series.gyro_dps[i] = std::sin(2.0 * std::numbers::pi * 3.45 * static_cast<double>(i) / 40.0);
  const auto lines = looked_at(series, {.first = 0, .count = series.size(), .mean_of = 40});
  for (const double mean : lines.gyro_dps) EXPECT_LT(std::abs(mean), 0.02);
  const NormalStream noise(1, 0, "views");
  for (std::size_t i = 0; i < series.size(); ++i)
    series.gyro_dps[i] = std::nearbyint(noise.normal(i));
  auto on_grid = looked_at(series, {.first = 0, .count = series.size(), .mean_of = 40}).gyro_dps;
  std::sort(on_grid.begin(), on_grid.end());
  const auto distinct = std::unique(on_grid.begin(), on_grid.end()) - on_grid.begin();
  EXPECT_GT(distinct, 900);
}

}  // namespace
}  // namespace gyrostat::gap::views_test
