#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/column_table.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/recordings/repeated_heading.hpp>
#include <gyrostat/tests/places.hpp>

namespace gyrostat::repeated_heading_test {

using testing::Contains;
using testing::HasSubstr;

constexpr std::size_t samples = 20'000;

struct Compass {
  std::vector<double> heading_deg;
  MagneticField field;
  std::size_t repeats = 0;
};

/// A compass of `share` of the recorder's rate; the heading has the accelerometer's noise, too.
Compass compass(double share, double field_grid_uT, double own_noise_deg) {
  std::mt19937_64 engine(20'411);
  std::normal_distribution<double> normal;
  Compass made;
  for (auto& component : made.field) component.resize(samples);
  double heading = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto readings = [&](std::size_t at) {
      return std::floor(share * static_cast<double>(at));
    };
    const bool is_new = i == 0 || readings(i) != readings(i - 1);
    if (is_new) heading = 30.0 + 0.4 * normal(engine);
    made.repeats += is_new ? 0 : 1;
    made.heading_deg.push_back(heading + own_noise_deg * normal(engine));
    for (auto& component : made.field)
      component[i] = is_new ? field_grid_uT * std::round(0.2 * normal(engine) / field_grid_uT)
                            : component[i - 1];
  }
  return made;
}

std::size_t missing(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [](double value) { return std::isnan(value); }));
}

TEST(RepeatedHeading, IsWhereTheFieldDidNotChange) {
  for (const double share : {0.75, 0.5, 0.1}) {
    auto made = compass(share, 0.09, 0.05);
    const auto left_out = leave_out_repeats(made.heading_deg, made.field);
    EXPECT_EQ(left_out, missing(made.heading_deg));
    // Three components on a grid of 0.45 deviations are the same by chance in (0.126)³ = 0.2 %.
    EXPECT_GE(left_out, made.repeats);
    EXPECT_LE(left_out, made.repeats + samples / 200);
  }
}

TEST(RepeatedHeading, IsThatOfTheSampleBeforeWhereThereIsNoField) {
  for (const double share : {0.75, 0.5, 0.1}) {
    auto made = compass(share, 0.09, 0.0);
    auto blank = made;  // one of the field's columns throughout
    std::ranges::fill(blank.field[1], no_value);
    EXPECT_EQ(leave_out_repeats(blank.heading_deg, blank.field), made.repeats);
    EXPECT_EQ(leave_out_repeats(made.heading_deg, {}), made.repeats);
    EXPECT_EQ(missing(made.heading_deg), made.repeats);
  }
}

TEST(RepeatedHeading, IsNoneWhereEverySampleIsNew) {
  auto fine = compass(1.0, 0.09, 0.0);
  EXPECT_EQ(leave_out_repeats(fine.heading_deg, {}), 0);
  EXPECT_EQ(leave_out_repeats(fine.heading_deg, fine.field), 0);
}

TEST(RepeatedHeading, IsNoneOnACoarseGridOrAtRest) {
  auto coarse = compass(1.0, 0.8, 0.0);  // a component repeats in nine of ten samples
  EXPECT_EQ(leave_out_repeats(coarse.heading_deg, coarse.field), 0);
  for (double& heading : coarse.heading_deg) heading = std::round(heading);
  EXPECT_EQ(leave_out_repeats(coarse.heading_deg, {}), 0);
  std::vector<double> table(samples);  // without noise, ten seconds of turning and ten of rest
  for (std::size_t i = 1; i < samples; ++i)
    table[i] = table[i - 1] +
               (i % 2000 < 1000 ? 0.01 * std::sin(static_cast<double>(i % 1000) / 318.3) : 0.0);
  EXPECT_EQ(leave_out_repeats(table, {}), 0);
}

TEST(RepeatedHeading, IsSaidOfARecording) {
  auto made = compass(0.5, 0.09, 0.0);
  ColumnTable columns;
  std::vector<double> t_s(samples), gyro_dps(samples, 0.1);
  for (std::size_t i = 0; i < samples; ++i) t_s[i] = static_cast<double>(i) / 100.0;
  columns.add("t_s", t_s);
  columns.add("gyro_dps", gyro_dps);
  columns.add("heading_deg", made.heading_deg);
  const auto recording = recording_of_columns(columns, "memory");
  EXPECT_EQ(missing(recording.series.heading_deg), samples / 2);
  EXPECT_THAT(recording.notes, Contains(HasSubstr("heading_deg: 10000 values repeat")));
}

/// The magnetometer of this recording is read 75 times a second, the gyro a hundred.
TEST(RepeatedHeading, LeavesWhiteNoiseOfARealCompass) {
  const auto path = std::filesystem::path(places::recordings()) / "mpu6050_static.csv.gz";
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << path << " is absent; GYROSTAT_RECORDINGS names the folder of recordings";
  const auto recording = read_recording(path, "x");
  const auto& heading = recording.series.heading_deg;
  const auto all = static_cast<double>(heading.size());
  EXPECT_NEAR(1.0 - static_cast<double>(missing(heading)) / all, 0.75, 0.005);
  double square = 0.0, fourth = 0.0, count = 0.0, last = no_value;
  for (const double value : heading) {
    if (std::isnan(value)) continue;
    if (!std::isnan(last)) {
      const double step = value - last;
      square += step * step;
      fourth += step * step * step * step;
      count += 1.0;
    }
    last = value;
  }
  // Of such steps the kurtosis has a standard error of √(24/n · (1 + 2/2⁴)) = 0.024, five of which
  // are exceeded once in two million; with the repeats it is 0.30.
  EXPECT_NEAR(fourth / count / (square / count * square / count) - 3.0, 0.0, 0.12);
}

}  // namespace gyrostat::repeated_heading_test
