#include <gyrostat/diagnosis/own_reference.hpp>

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrostat::gap {
namespace {

/// A gyro that senses `slope` of a reference of 40 dps, beside a motion of its own.
Series turning(double slope, double own_dps) {
  Series series;
  for (int i = 0; i < 4000; ++i) {
    series.t_s.push_back(0.01 * i);
    series.rate_ref_dps.push_back(40.0 * std::sin(0.01 * i));
    series.gyro_dps.push_back(slope * series.rate_ref_dps.back() + own_dps * std::cos(0.37 * i));
  }
  return series;
}

TEST(OwnReference, ItsShareIsThatOfTheSensedRate) {
  EXPECT_NEAR(share_of_reference(turning(0.03, 0.1)).slope, 0.03, 1e-3);
  EXPECT_TRUE(is_of_another_axis(share_of_reference(turning(0.03, 0.1))));
  EXPECT_FALSE(is_of_another_axis(share_of_reference(turning(0.97, 0.1))));
  EXPECT_FALSE(is_of_another_axis(share_of_reference(turning(-1.0, 0.1))));
}

TEST(OwnReference, IsNotDoubtedWhereTheGyroMovesByItself) {
  EXPECT_FALSE(is_of_another_axis(share_of_reference(turning(0.0, 20.0))));
}

TEST(OwnReference, OneThatIsMissingOrNeverChangesIsOfEveryAxis) {
  Series series = turning(0.0, 0.1);
  series.rate_ref_dps.assign(series.size(), 0.0);
  EXPECT_FALSE(is_of_another_axis(share_of_reference(series)));
  series.rate_ref_dps.clear();
  EXPECT_FALSE(is_of_another_axis(share_of_reference(series)));
}

TEST(OwnReference, OtherUnitsAndSensesAreDoubted) {
  using testing::HasSubstr;
  const auto doubt = [](double slope, double own_dps) {
    return doubt_of_reference(share_of_reference(turning(slope, own_dps)));
  };
  EXPECT_THAT(doubt(0.01745, 1e-3), HasSubstr("--units gyro=rad/s"));
  EXPECT_THAT(doubt(57.3, 1.0), HasSubstr("--units rate_ref=rad/s"));
  EXPECT_THAT(doubt(-1.02, 0.1), HasSubstr("change its sign"));
  EXPECT_EQ(doubt(1.02, 0.1), "");
  EXPECT_EQ(doubt(0.0175, 20.0), "");  // an axis of its own
  EXPECT_EQ(doubt_of_reference({}), "");
}

}  // namespace
}  // namespace gyrostat::gap
