#include <gyrostat/diagnosis/line_source.hpp>

#include <gmock/gmock.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {
namespace {

using testing::HasSubstr;

constexpr std::size_t samples = 12'000;  // two minutes at 100 Hz
constexpr double line_hz = 12.0;

Effect line_of(const char* id) {
  Effect effect(effect_types().named(id, "test"));
  for (std::size_t f = 0; f < effect.fields().size(); ++f) {
    const auto name = effect.fields()[f].name;
    if (name == "centre_hz" || name == "frequency_hz") effect.value(f) = line_hz;
    if (name == "bandwidth_hz") effect.value(f) = 1.0;
    if (name == "mean_interval_s") effect.value(f) = 10.0;  // so that two minutes hold some
    if (name == "std_dps" || name == "amplitude_dps") effect.value(f) = 0.05;
  }
  return effect;
}

std::vector<double> white(std::uint32_t trial, const char* name, double std) {
  std::vector<double> values(samples);
  NormalStream(7, trial, name).fill(0, values);
  for (auto& v : values) v *= std;
  return values;
}

/// The line in the gyro's noise, and alone in `shaking`.
Series with_line(const Effect& line, std::uint32_t trial, std::vector<double>& shaking) {
  Series series;
  for (std::size_t k = 0; k < samples; ++k) series.t_s.push_back(0.01 * static_cast<double>(k));
  series.gyro_dps.assign(samples, 0.0);
  line.apply(series, {7, trial});
  shaking = series.gyro_dps;
  const auto noise = white(trial, "gyro", 0.05);
  for (std::size_t k = 0; k < samples; ++k) series.gyro_dps[k] += noise[k];
  return series;
}

std::vector<double> felt(const std::vector<double>& shaking, double gain,
                         std::vector<double> noise) {
  for (std::size_t k = 0; k < noise.size(); ++k) noise[k] += gain * shaking[k];
  return noise;
}

LineSource source_of(const Series& series, const Effect& line) {
  const auto found = line_sources(series, {line});
  EXPECT_EQ(found.size(), 1u);
  return found.empty() ? LineSource::undecided : found.front().source;
}

/// A shaken accelerometer has the line a quarter as strong as its noise.
TEST(LineSource, IsMechanicalWhereAnAccelerometerShowsTheLine) {
  for (const char* id : {"vibration", "vibration_bursts", "wandering_line", "sinusoidal"}) {
    const auto line = line_of(id);
    std::vector<double> shaking;
    auto series = with_line(line, 0, shaking);
    series.acc_x_mps2 = white(0, "acc_x", 0.02);
    series.acc_y_mps2 = felt(shaking, 0.2, white(0, "acc_y", 0.02));
    series.acc_z_mps2 = white(0, "acc_z", 0.02);
    const auto found = line_sources(series, {line});
    ASSERT_EQ(found.size(), 1u) << id;
    EXPECT_EQ(found.front().source, LineSource::mechanical) << id;
    EXPECT_EQ(found.front().channel, "acc_y_mps2") << id;
    EXPECT_THAT(in_words(found), HasSubstr("mechanical, the sensor is shaken"));
  }
}

/// Of 500 recordings whose accelerometer knows nothing of the line, mechanical is said with
/// probability 0.001 or less each: five or more in one of 5000 suites. Electronic is said of 95 %
/// or more, with a standard error of 1 %: of fewer than 90 % in one of three million.
TEST(LineSource, IsElectronicWhereNoChannelShowsTheLine) {
  const auto line = line_of("vibration");
  int mechanical = 0, electronic = 0;
  for (std::uint32_t trial = 0; trial < 500; ++trial) {
    std::vector<double> shaking;
    auto series = with_line(line, trial, shaking);
    series.acc_x_mps2 = white(trial, "acc_x", 0.02);
    series.cross_rate_1_dps = white(trial, "cross", 0.05);
    const auto source = source_of(series, line);
    mechanical += source == LineSource::mechanical;
    electronic += source == LineSource::electronic;
  }
  EXPECT_LT(mechanical, 5);
  EXPECT_GE(electronic, 450);
}

TEST(LineSource, IsUndecidedWhereOtherAxesShowTheLineAndThereIsNoAccelerometer) {
  const auto line = line_of("vibration");
  std::vector<double> shaking;
  auto series = with_line(line, 0, shaking);
  EXPECT_TRUE(line_sources(series, {line}).empty()) << "nothing stands beside the gyro";
  series.cross_rate_1_dps = white(0, "cross_1", 0.05);
  series.cross_rate_2_dps = felt(shaking, -0.5, white(0, "cross_2", 0.05));
  EXPECT_EQ(source_of(series, line), LineSource::undecided);
  EXPECT_THAT(in_words(line_sources(series, {line})), HasSubstr("an accelerometer beside it"));
  series.acc_z_mps2 = white(0, "acc_z", 0.02);
  EXPECT_EQ(source_of(series, line), LineSource::electronic);
  EXPECT_THAT(in_words(line_sources(series, {line})), HasSubstr("not in the accelerometer"));
}

TEST(LineSource, IsOfLinesAlone) {
  const auto line = line_of("vibration");
  std::vector<double> shaking;
  auto series = with_line(line, 0, shaking);
  series.acc_x_mps2 = white(0, "acc_x", 0.02);
  EXPECT_TRUE(line_sources(series, {Effect(effect_types().named("outliers", "test"))}).empty());
  EXPECT_EQ(in_words({}), "");
}

}  // namespace
}  // namespace gyrostat::gap
