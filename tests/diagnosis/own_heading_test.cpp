#include <gyrostat/diagnosis/own_heading.hpp>

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/values.hpp>

namespace gyrostat::gap::own_heading_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double interval_s = 0.025;
constexpr double noise_dps = 0.05;

/// A gyro about z that turns by `turn_dps`, one about y that turns by `cross_dps`, and a heading
/// that is the sum of a turning of `heading_dps`, a walk and white noise, to a grid.
struct Motion {
  double turn_dps = 0.0, cross_dps = 0.0, heading_dps = 0.0;
  double walk_deg = 0.0, white_deg = 0.0, grid_deg = 1e-6;
};

Series recording(const Motion& motion) {
  std::mt19937_64 engine(20'390);
  std::normal_distribution<double> normal;
  Series series;
  double heading_deg = 170.0, walk_deg = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double swing = std::sin(0.4 * interval_s * i);
    series.t_s.push_back(interval_s * i);
    series.gyro_dps.push_back(motion.turn_dps * swing + noise_dps * normal(engine));
    series.cross_rate_1_dps.push_back(motion.cross_dps * swing + noise_dps * normal(engine));
    series.cross_rate_2_dps.push_back(noise_dps * normal(engine));
    heading_deg += interval_s * motion.heading_dps * swing;
    walk_deg += motion.walk_deg * normal(engine);
    const double read_deg = heading_deg + walk_deg + motion.white_deg * normal(engine);
    series.heading_deg.push_back(
        wrap_degrees(motion.grid_deg * std::round(read_deg / motion.grid_deg)));
  }
  return series;
}

TEST(OwnHeading, ACompassIsKept) {
  EXPECT_EQ(heading_of(recording({.white_deg = 0.3})), HeadingOf::compass);
  EXPECT_EQ(heading_of(recording({.walk_deg = 0.1, .white_deg = 0.3})), HeadingOf::compass);
  EXPECT_EQ(heading_of(recording({.turn_dps = 40.0, .heading_dps = 40.0, .white_deg = 0.3})),
            HeadingOf::compass);
  EXPECT_EQ(heading_of(Series{}), HeadingOf::compass);
}

TEST(OwnHeading, AReferenceThatStandsStillOrTurnsWithTheGyroIsKept) {
  EXPECT_EQ(heading_of(recording({})), HeadingOf::compass);
  EXPECT_EQ(heading_of(recording({.turn_dps = 40.0, .heading_dps = 40.0})), HeadingOf::compass);
}

TEST(OwnHeading, AFiltersIsToldAtRestThoughItIsRounded) {
  constexpr double step_deg = interval_s * noise_dps;
  EXPECT_EQ(heading_of(recording({.walk_deg = step_deg})), HeadingOf::filter);
  EXPECT_EQ(heading_of(recording({.walk_deg = step_deg, .grid_deg = 0.01})), HeadingOf::filter);
}

/// A table that turns by no more than the gyro's noise, beside a heading without any.
TEST(OwnHeading, ASlowTableIsNoFilter) {
  auto series = recording({.turn_dps = 0.1, .heading_dps = 0.1});
  EXPECT_EQ(heading_of(series), HeadingOf::filter);  // as far as one can see
  for (std::size_t i = 0; i < series.size(); ++i)
    series.rate_ref_dps.push_back(0.1 * std::sin(0.4 * series.t_s[i]));
  EXPECT_EQ(heading_of(series), HeadingOf::compass);
}

TEST(OwnHeading, OneThatTurnsWithAnotherGyroIsThatOnes) {
  EXPECT_EQ(heading_of(recording({.cross_dps = 40.0, .heading_dps = 40.0, .white_deg = 0.3})),
            HeadingOf::another_axis);
  // A compass that is disturbed does not turn with any gyro.
  EXPECT_EQ(heading_of(recording({.heading_dps = 40.0, .white_deg = 0.3})), HeadingOf::compass);
}

TEST(OwnHeading, WhatIsLeftOutIsTold) {
  std::vector<std::string> told;
  EXPECT_THAT(without_foreign_heading(recording({.walk_deg = 0.001}), told).heading_deg, IsEmpty());
  EXPECT_THAT(told, ElementsAre(HasSubstr("a filter made it, and it is left out")));
  told.clear();
  EXPECT_FALSE(without_foreign_heading(recording({.white_deg = 0.3}), told).heading_deg.empty());
  EXPECT_THAT(told, IsEmpty());
}

}  // namespace gyrostat::gap::own_heading_test
