// Texts as loggers write them: without header, without times, with counts, dates, NaN, UTF-16.

#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/calendar.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::dialect_test {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

RecordingLayout layout(const std::string& columns, const std::string& units = "",
                       double rate_hz = 0) {
  RecordingLayout layout;
  layout.columns = parse_assignments(columns, "--columns");
  layout.units = parse_assignments(units, "--units");
  layout.place = "--columns";
  layout.rate_hz = rate_hz;
  return layout;
}

Recording read(const std::string& text, const RecordingLayout& how = {},
               const std::string& axis = "") {
  const TestFolder folder;
  folder.write("rec.csv", text);
  return read_recording(folder.path() / "rec.csv", axis, how);
}

std::string refusal(const std::string& text, const RecordingLayout& how = {}) {
  try {
    read(text, how);
  } catch (const InputError& mistake) {
    return mistake.what();
  }
  return "no error";
}

TEST(Dialect, WithoutAHeaderColumnsGoByTheirNumbers) {
  for (const std::string text :
       {"0,9,9,131\n0.01,9,9,-262\n", "0 9 9 131\n0.01 9 9 -262\n",
        "# by a logger\n  0.0e0   9  9 131 \n 0.01\t9 9  -262\n", "0;9;9;131\n0,01;9;9;-262\n"})
    for (const char* columns : {"1=t,4=gyro", "t=1,gyro=4"}) {
      const auto series = read(text, layout(columns, "gyro=lsb/131")).series;
      EXPECT_THAT(series.t_s, ElementsAre(0, 0.01)) << text;
      EXPECT_THAT(series.gyro_dps, ElementsAre(1, -2)) << text;
    }
  EXPECT_THAT(refusal("0,1,2\n", layout("1=t,4=gyro", "gyro=dps")),
              AllOf(HasSubstr("no column 4"), HasSubstr("1 to 3")));
  EXPECT_THAT(refusal("0,1,2\n"), AllOf(HasSubstr("--columns"), HasSubstr("--rate")));
}

TEST(Dialect, ARateStandsForTimes) {
  const auto series = read("w[rad/s]\n1\n2\n3\n", layout("gyro=w", "", 200)).series;
  EXPECT_THAT(series.t_s, ElementsAre(0, 0.005, 0.01));
}

TEST(Dialect, ARateOfNoUnitIsAskedFor) {
  EXPECT_THAT(refusal("seconds,z\n0,1\n", layout("t=seconds,gyro=z")),
              AllOf(HasSubstr("'z'"), HasSubstr("--units gyro=rad/s")));
}

TEST(Dialect, OneUnitIsThatOfAllAxes) {
  const auto series = read("t_s,a,b,c\n0,1,2,1000\n1,1,2,3000\n",
                           layout("gyro_x=a,gyro_y=b,gyro_z=c", "gyro=mdps"), "z")
                          .series;
  EXPECT_THAT(series.gyro_dps, ElementsAre(1, 3));
}

TEST(Dialect, DatesAreTimes) {
  const auto series = read(
                          "when,gyro_dps\n2026-02-28T23:59:59.990Z,1\n2026-03-01T00:00:00.000Z,2\n"
                          "2026-03-01 01:00:00.010+01:00,3\n",
                          layout("t=when"))
                          .series;
  EXPECT_THAT(series.t_s, ElementsAre(0, DoubleNear(0.01, 1e-6), DoubleNear(0.02, 1e-6)));
  EXPECT_EQ(seconds_of_calendar("1970-01-02T00:00:00Z"), 86400);
  EXPECT_EQ(seconds_of_calendar("2000-02-29 12:30:15"), 951827415);
  for (const char* text :
       {"2026-02-30T00:00:00", "2026-01-01", "12:00:00", "2026-01-01T00:00:00X", ""})
    EXPECT_FALSE(seconds_of_calendar(text)) << text;
}

TEST(Dialect, TimesSince1970CountFromTheFirstSample) {
  const auto recording =
      read("t_ns,gyro_dps\n1700000000000000000,1\n1700000000005000000,2\n", layout("t=t_ns[ns]"));
  EXPECT_THAT(recording.series.t_s, ElementsAre(0, DoubleNear(0.005, 1e-6)));
}

TEST(Dialect, WordsForNoNumberAreMissingAndInfinitiesAreSaid) {
  const auto recording = read("t_s,gyro_dps\n0,1\n1,NaN\n2,-nan\n3,NA\n4,inf\n5,-Infinity\n6,2\n");
  EXPECT_THAT(recording.series.gyro_dps,
              ElementsAre(1, IsNan(), IsNan(), IsNan(), IsNan(), IsNan(), 2));
  EXPECT_THAT(recording.notes, ElementsAre(AllOf(HasSubstr("2 infinite"), HasSubstr("line 6"))));
}

TEST(Dialect, Utf16IsText) {
  const std::string text = "t_s,gyro_dps,note\n0,0.5,\xc2\xb5\n1,-0.25,x\n";
  const std::u16string wide = u"t_s,gyro_dps,note\n0,0.5,\u00b5\n1,-0.25,x\n";
  std::string little = "\xff\xfe", big = "\xfe\xff", bare;
  for (const char16_t c : wide) {
    const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
    (little += low) += high;
    (big += high) += low;
    (bare += low) += high;
  }
  for (const auto& bytes : {text, little, big, bare})
    EXPECT_THAT(read(bytes).series.gyro_dps, ElementsAre(0.5, -0.25));
}

TEST(Dialect, RowsAreReadInBlocksOfAnyPlace) {
  // Longer than a block, so that rows lie across its end.
  std::string text = "t_s,gyro_dps\n";
  for (int i = 0; i < 400'000; ++i) text += fmt::format("{},{}.5\n", i, i % 97);
  const auto series = read(text).series;
  ASSERT_EQ(series.size(), 400'000u);
  for (std::size_t i = 0; i < series.size(); ++i) {
    ASSERT_EQ(series.t_s[i], static_cast<double>(i));
    ASSERT_EQ(series.gyro_dps[i], static_cast<double>(i % 97) + 0.5);
  }
}

TEST(Dialect, StandardInputIsAFile) {
  const TestFolder folder;
  std::string text = "t_s,gyro_dps\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{}\n", 0.01 * i, i % 3);
  folder.write("rec.csv", text);
  const auto at = [&](const std::string& name) { return (folder.path() / name).string(); };
  const auto command = fmt::format("cat '{}' | '{}' allan - --format csv > '{}'", at("rec.csv"),
                                   places::program(), at("out.csv"));
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(folder.read("out.csv"), HasSubstr("0.01,"));
}

}  // namespace
}  // namespace gyrostat::dialect_test
