#include <gyrostat/diagnosis/unreferenced_turning.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/diagnosis/catalogue/misalignment.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap::unreferenced_turning_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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

std::size_t known_of(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [](double x) { return !std::isnan(x); }));
}

/// Thirty seconds of it it turns, and half a second beside is not looked at either.
TEST(UnreferencedTurning, ItsRestsAreLookedAtAlone) {
  auto series = recording([](double t_s) { return t_s < 40.0 || t_s > 70.0 ? 0.0 : 60.0; });
  series.heading_deg.assign(series.size(), 0.0);
  const auto turning = turning_without_reference(series);
  EXPECT_NEAR(turning.extent_dps, 60.0, 1.0);
  EXPECT_NEAR(turning.rest_s, 69.0, 1.0);  // in quarters of a second
  std::vector<std::string> told;
  const auto rests = without_turning(series, told);
  EXPECT_THAT(told, ElementsAre(HasSubstr("at rest are looked at")));
  EXPECT_NEAR(static_cast<double>(known_of(rests.gyro_dps)), 50.0 * turning.rest_s, 1.0);
  EXPECT_EQ(known_of(rests.cross_rate_2_dps), known_of(rests.gyro_dps));
  EXPECT_THAT(rests.heading_deg, IsEmpty());
  for (std::size_t i = 0; i < rests.size(); ++i)
    EXPECT_TRUE(series.t_s[i] < 39.9 || series.t_s[i] > 70.1 || std::isnan(rests.gyro_dps[i]));
}

/// A centrifuge spins evenly for most of the time, which is no rest.
TEST(UnreferencedTurning, AnEvenTurnIsNoRest) {
  const auto turning =
      turning_without_reference(recording([](double t_s) { return t_s < 30.0 ? 0.0 : 500.0; }));
  EXPECT_NEAR(turning.rest_s, 29.5, 0.5);
  EXPECT_EQ(turning.at_rest.front(), 1);
  EXPECT_EQ(turning.at_rest.back(), 0);
}

TEST(UnreferencedTurning, OneThatHardlyRestsIsLeftAsItIs) {
  const auto series = recording([](double t_s) { return 30.0 * std::sin(t_s); });
  std::vector<std::string> told;
  EXPECT_EQ(known_of(without_turning(series, told).gyro_dps), series.size());
  EXPECT_THAT(told, ElementsAre(HasSubstr("is taken for errors")));
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
