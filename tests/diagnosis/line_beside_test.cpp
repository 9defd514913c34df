#include <gyrostat/diagnosis/starts/line_beside.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/catalogue/bias_steps.hpp>

namespace gyrostat::gap {
namespace {

constexpr double rate_hz = 20.0, duration_s = 1200.0;

double sine(double frequency_hz, double t_s) {
  return std::sin(2.0 * std::numbers::pi * frequency_hz * t_s + 0.4);
}

/// Twenty minutes with something beside the gyro.
template <typename Value>
Conditions with(std::vector<double> Series::*channel, Value value) {
  Series series;
  for (int k = 0; k < static_cast<int>(duration_s * rate_hz); ++k) {
    const double t_s = k / rate_hz;
    series.t_s.push_back(t_s);
    series.gyro_dps.push_back(0.0);
    (series.*channel).push_back(value(t_s));
  }
  return Conditions(series);
}

TEST(LineBeside, IsWhatAnotherAxisTurnsBy) {
  const auto turning =
      with(&Series::cross_rate_1_dps, [](double t_s) { return 3.0 + 40.0 * sine(0.053, t_s); });
  EXPECT_TRUE(is_line_beside(turning, 0.053));
  EXPECT_FALSE(is_line_beside(turning, 0.06));
  EXPECT_FALSE(is_line_beside(turning, 0.3));
}

TEST(LineBeside, IsTheSquareOfATemperatureThatSwings) {
  const auto cycling =
      with(&Series::temperature_C, [](double t_s) { return 40.0 + 17.0 * sine(1.0 / 400.0, t_s); });
  EXPECT_TRUE(is_line_beside(cycling, 1.0 / 400.0));
  EXPECT_TRUE(is_line_beside(cycling, 1.0 / 200.0));
  EXPECT_FALSE(is_line_beside(cycling, 1.0 / 120.0));
}

TEST(LineBeside, IsNotOneOfManyThatAChannelHas) {
  const auto busy = with(&Series::acc_x_mps2, [](double t_s) {
    return 9.8 + sine(0.1, t_s) + sine(0.23, t_s) + sine(0.31, t_s);
  });
  EXPECT_FALSE(is_line_beside(busy, 0.1));
}

TEST(LineBeside, IsNoShaking) {
  const auto shaken = with(&Series::acc_x_mps2, [](double t_s) { return 5.0 * sine(4.3, t_s); });
  EXPECT_FALSE(is_line_beside(shaken, 4.3));
}

TEST(LineBeside, IsOfWhatIsThere) {
  const auto gaps = with(&Series::acc_x_mps2,
                         [](double t_s) { return t_s < 300.0 ? no_value : -9.8 + sine(0.1, t_s); });
  EXPECT_TRUE(is_line_beside(gaps, 0.1));
  const auto constant = with(&Series::acc_x_mps2, [](double) { return 9.8; });
  EXPECT_FALSE(is_line_beside(constant, 0.1));
  const auto nothing = with(&Series::acc_x_mps2, [](double) { return no_value; });
  EXPECT_FALSE(is_line_beside(nothing, 0.1));
}

TEST(BiasSteps, AreRareAndNoTurns) {
  const auto still = with(&Series::temperature_C, [](double) { return 25.0; });
  const auto is_steps = [&](double steps_per_hour, double std_dps) {
    return Diagnosed<effects::BiasSteps>::is_what_it_is_called({steps_per_hour, std_dps}, still);
  };
  EXPECT_TRUE(is_steps(20.0, 0.15));
  EXPECT_TRUE(is_steps(480.0, 0.05));
  EXPECT_FALSE(is_steps(3134.0, 0.05));
  EXPECT_FALSE(is_steps(20.0, 17.0));
}

}  // namespace
}  // namespace gyrostat::gap
