#include <gyrostat/diagnosis/unreferenced_turning.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/diagnosis/catalogue/misalignment.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap::unreferenced_turning_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Three gyros at 50 Hz for a hundred seconds; `rate` is added about the third.
template <class Rate>
Series recording(const Rate& rate) {
  std::mt19937_64 engine(20'391);
  std::normal_distribution<double> normal(0.0, 0.1);
  Series series;
  for (int i = 0; i < 5000; ++i) {
    series.t_s.push_back(0.02 * i);
    series.gyro_dps.push_back(3.0 + normal(engine));
    series.cross_rate_1_dps.push_back(normal(engine));
    series.cross_rate_2_dps.push_back(rate(0.02 * i) + normal(engine));
  }
  return series;
}

TEST(UnreferencedTurning, ItsLongestRestIsTold) {
  const auto turning = turning_without_reference(
      recording([](double t_s) { return t_s < 40.0 || t_s > 70.0 ? 0.0 : 60.0; }));
  ASSERT_TRUE(turning);
  EXPECT_NEAR(turning->extent_dps, 60.0, 1.0);
  EXPECT_NEAR(turning->rest_from_s, 1.0, 0.3);
  EXPECT_NEAR(turning->rest_to_s, 39.0, 0.3);
  EXPECT_THAT(in_words(*turning), HasSubstr("--from 1.0 --to 38.8"));
}

TEST(UnreferencedTurning, OneThatNeverRestsIsToldWithoutOne) {
  const auto turning =
      turning_without_reference(recording([](double t_s) { return 30.0 * std::sin(t_s); }));
  ASSERT_TRUE(turning);
  EXPECT_THAT(in_words(*turning), Not(HasSubstr("--from")));
}

TEST(UnreferencedTurning, ShakingAKnockAndADriftAreNone) {
  EXPECT_FALSE(turning_without_reference(
      recording([](double t_s) { return 20.0 * std::sin(2.0 * std::numbers::pi * 16.0 * t_s); })));
  EXPECT_FALSE(turning_without_reference(
      recording([](double t_s) { return t_s > 50.0 && t_s < 50.5 ? 90.0 : 0.0; })));
  EXPECT_FALSE(turning_without_reference(recording([](double t_s) { return 0.1 * t_s; })));
}

TEST(UnreferencedTurning, WithAReferenceItIsKnown) {
  auto series = recording([](double t_s) { return 30.0 * std::sin(t_s); });
  series.rate_ref_dps.assign(series.size(), 0.0);
  EXPECT_FALSE(turning_without_reference(series));
}

/// A share of the other axes' rates needs their turning: what they feel of shaking is the
/// shaking's.
TEST(Misalignment, IsNotAssessedWhereTheOtherAxesAreOnlyShaken) {
  const auto why = [](const Series& series) {
    return Diagnosed<effects::Misalignment>::why_not_assessable(Simulator(series, 1).conditions());
  };
  EXPECT_THAT(why(recording(
                  [](double t_s) { return 20.0 * std::sin(2.0 * std::numbers::pi * 16.0 * t_s); })),
              HasSubstr("at least 5 dps are needed"));
  EXPECT_THAT(why(recording([](double t_s) { return 30.0 * std::sin(t_s); })), IsEmpty());
}

}  // namespace gyrostat::gap::unreferenced_turning_test
