#include <gyrostat/core/series.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/filters/none.hpp>
#include <gyrostat/core/track.hpp>

namespace gyrostat::series_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Ten samples at 2 Hz from 100 s on.
Series ten() {
  Series series;
  for (int i = 0; i < 10; ++i) {
    series.t_s.push_back(100.0 + 0.5 * i);
    series.gyro_dps.push_back(i);
    series.heading_deg.push_back(10.0 * i);
  }
  return series;
}

TEST(Series, RateAndDurationCountIntervals) {
  EXPECT_EQ(ten().rate_hz(), 2.0);
  EXPECT_EQ(ten().duration_s(), 4.5);
  EXPECT_EQ(Series{}.rate_hz(), 0.0);
  EXPECT_EQ(ten().slice(3, 1).rate_hz(), 0.0);
}

TEST(Series, ASliceHasTheSamplesOfEveryPresentChannel) {
  const auto part = ten().slice(8, 5);
  EXPECT_THAT(part.gyro_dps, ElementsAre(8, 9));
  EXPECT_THAT(part.heading_deg, ElementsAre(80, 90));
  EXPECT_THAT(part.temperature_C, IsEmpty());
}

TEST(Series, ACutIsHalfOpenAndCountsFromTheFirstSample) {
  EXPECT_THAT(cut(ten(), 1.0, 2.5, "here").gyro_dps, ElementsAre(2, 3, 4));
  EXPECT_EQ(cut(ten(), 0.0, 1e12, "here").size(), 10U);
}

TEST(Series, AnEmptyCutNamesThePlace) {
  try {
    cut(ten(), 5.0, 9.0, "study.json: from_recording");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("study.json: from_recording"));
  }
}

TEST(Series, ClearedHasNoChannelLeft) {
  auto series = ten();
  series.clear();
  for (const auto& channel : channels) EXPECT_THAT(series.*channel.values, IsEmpty());
}

TEST(Track, TheHeadingIsHiddenWhereTheCompassIsFlagged) {
  auto series = ten();
  EXPECT_EQ(sample_at(series, 3).heading_deg, 30.0);
  series.mag_valid.assign(10, 1.0);
  series.mag_valid[3] = 0.0;
  series.mag_valid[4] = no_value;
  EXPECT_TRUE(is_missing(sample_at(series, 3).heading_deg));
  EXPECT_TRUE(is_missing(sample_at(series, 4).heading_deg));
  EXPECT_EQ(sample_at(series, 5).heading_deg, 50.0);
}

TEST(Track, AnAbsentChannelIsWithoutValue) {
  const auto sample = sample_at(ten(), 0);
  EXPECT_TRUE(is_missing(sample.temperature_C));
  EXPECT_TRUE(is_missing(sample.true_rate_dps));
}

TEST(Track, MissingChannelsAreNamed) {
  const auto series = ten();
  EXPECT_THAT(missing_channels({}, series), IsEmpty());
  EXPECT_THAT(missing_channels({.temperature = true, .heading = true}, series),
              ElementsAre("temperature_C"));
  EXPECT_THAT(missing_channels({.truth = true}, series),
              ElementsAre("rate_ref_dps", "thermal_bias_dps"));
}

TEST(Track, StatusCountsAddUpToTheSamples) {
  Track track;
  run_filter(filters::None<double>({}), ten(), track);
  EXPECT_THAT(track.status_counts(), ElementsAre(10, 0, 0, 0, 0));
  track.status[2] = Status::risk_breakdown;
  track.status[5] = Status::no_measurement;
  EXPECT_THAT(track.status_counts(), ElementsAre(8, 1, 1, 0, 0));
}

TEST(Status, BreakdownsAreThoseAfterNoMeasurement) {
  EXPECT_FALSE(is_breakdown(Status::ok));
  EXPECT_FALSE(is_breakdown(Status::no_measurement));
  for (const Status status :
       {Status::risk_breakdown, Status::indefinite_covariance, Status::not_finite})
    EXPECT_TRUE(is_breakdown(status)) << name_of(status);
}

}  // namespace
}  // namespace gyrostat::series_test
