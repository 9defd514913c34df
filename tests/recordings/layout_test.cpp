// Recordings as other programs lay them out: other names, units, separators, comments, MATLAB
// files.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/recordings/write_columns.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::layout_test {
namespace {

using testing::AllOf;
using testing::DoubleEq;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RecordingLayout layout(const std::string& columns, const std::string& units = "") {
  return {parse_assignments(columns, "--columns"), parse_assignments(units, "--units"),
          "--columns"};
}

Series read(const std::string& text, const RecordingLayout& how = {},
            const std::string& axis = "") {
  const TestFolder folder;
  folder.write("rec.csv", text);
  return read_recording(folder.path() / "rec.csv", axis, how).series;
}

std::string refusal(const std::string& text, const RecordingLayout& how = {}) {
  try {
    read(text, how);
  } catch (const InputError& mistake) {
    return mistake.what();
  }
  return "no error";
}

TEST(Layout, ColumnsAreFoundByTheirNamesAndConvertedByTheirUnits) {
  const auto series =
      read("Time[ms],GyrX,GyrZ [rad/s],Temp (F)\n0,9,0,32\n10,9,3.141592653589793,212\n",
           layout("t=Time[ms],gyro=GyrZ,temp=Temp"));
  EXPECT_THAT(series.t_s, ElementsAre(0, 0.01));
  EXPECT_THAT(series.gyro_dps, ElementsAre(0, 180));
  EXPECT_THAT(series.temperature_C, ElementsAre(DoubleEq(0), DoubleEq(100)));
}

TEST(Layout, EveryUnitIsWhatItsDefinitionSays) {
  const auto value_in = [](const std::string& channel, const std::string& unit,
                           const std::string& value) {
    const auto series =
        read("a,b,c\n" + std::string(channel == "t" ? value : "0") + ",1," + value + "\n",
             layout(channel == "t"      ? "t=a,gyro=b[dps]"
                    : channel == "gyro" ? "t=a,gyro=c"
                                        : "t=a,gyro=b[dps]," + channel + "=c",
                    channel + "=" + unit));
    return channel == "t"       ? series.t_s[0]
           : channel == "gyro"  ? series.gyro_dps[0]
           : channel == "temp"  ? series.temperature_C[0]
           : channel == "acc_x" ? series.acc_x_mps2[0]
                                : series.heading_deg[0];
  };
  EXPECT_EQ(value_in("t", "ms", "30"), 0.03);
  EXPECT_EQ(value_in("t", "us", "30"), 3e-5);
  EXPECT_EQ(value_in("t", "µs", "30"), 3e-5);
  EXPECT_EQ(value_in("t", "ns", "30"), 3e-8);
  EXPECT_EQ(value_in("t", "min", "2"), 120);
  EXPECT_EQ(value_in("gyro", "mdps", "250"), 0.25);
  EXPECT_EQ(value_in("gyro", "deg/h", "7200"), 2);
  EXPECT_DOUBLE_EQ(value_in("gyro", "rad/s", "2"), 360 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(value_in("gyro", "mrad/s", "2"), 0.36 / std::numbers::pi);
  EXPECT_EQ(value_in("temp", "K", "300"), 300 - 273.15);
  EXPECT_DOUBLE_EQ(value_in("temp", "°F", "-40"), -40);
  EXPECT_DOUBLE_EQ(value_in("temp", "mC", "25000"), 25);
  EXPECT_DOUBLE_EQ(value_in("acc_x", "g", "1"), 9.80665);
  EXPECT_DOUBLE_EQ(value_in("heading", "rad", "-1"), -180 / std::numbers::pi);
  EXPECT_EQ(value_in("heading", "deg", "270"), -90);
  EXPECT_NEAR(value_in("heading", "rad", "6.2832"), 0, 1e-3);  // four decimals of 2 pi
}

TEST(Layout, TheUnitThatIsGivenComesBeforeBracketsBeforeTheRowOfUnitsBeforeTheEnding) {
  const auto gyro = [](const std::string& text, const RecordingLayout& how) {
    return read(text, how).gyro_dps[0];
  };
  EXPECT_EQ(gyro("t_s,w_mdps\n0,500\n", layout("gyro=w_mdps", "gyro=dps")), 500);
  EXPECT_EQ(gyro("t_s,w\n0,500\n", layout("gyro=w[mdps]")), 0.5);
  EXPECT_EQ(gyro("t_s,w[mdps]\n0,500\n", layout("gyro=w")), 0.5);
  EXPECT_EQ(gyro("t_s,w\ns,mdps\n0,500\n", layout("gyro=w")), 0.5);
  EXPECT_EQ(gyro("t_s,w\n[s],[mdps]\n0,500\n", layout("gyro=w")), 0.5);
  EXPECT_EQ(gyro("t_s,w_z_mdps\n0,500\n", layout("gyro=w_z_mdps")), 0.5);
  EXPECT_EQ(gyro("t_s,gyro_dps\n0,500\n", layout("", "gyro=mdps")), 0.5);
}

TEST(Layout, AxesAreMappedAndThenChosen) {
  const auto how = layout("gyro_x=GX[dps],gyro_z=GZ", "gyro_z=mdps");
  EXPECT_THAT(read("t_s,GX,GZ\n0,1,2000\n", how, "z").gyro_dps, ElementsAre(2));
  EXPECT_THAT(read("t_s,GX,GZ\n0,1,2000\n", how, "x").gyro_dps, ElementsAre(1));
}

TEST(Layout, SeparatorsCommentsQuotesAndLineEndsDoNotMatter) {
  for (const std::string text :
       {"t_s,gyro_dps\n0,0.5\n1,-2.5e-1\n", "\xef\xbb\xbft_s,gyro_dps\r\n0,0.5\r\n1,-0.25\r\n",
        "t_s;gyro_dps\n0;0,5\n1;-0,25\n", "t_s;gyro_dps\n0;0.5\n1;-0.25\n",
        "t_s\tgyro_dps\n0\t0.5\n1\t-0.25\n", "t_s, gyro_dps\n 0 ,  0.5\n 1 , -0.25\n",
        "# a logger\n% of some kind\n// version 3\n\nt_s,gyro_dps\n0,0.5\n1,-0.25\n",
        "# t_s,gyro_dps\n0,0.5\n1,-0.25\n", "t_s,gyro_dps\ns,dps\n0,0.5\n1,-0.25\n",
        "\"t_s\",\"gyro_dps\"\n\"0\",\"0.5\"\n\"1\",\"-0.25\"\n"}) {
    const auto series = read(text);
    EXPECT_THAT(series.t_s, ElementsAre(0, 1)) << text;
    EXPECT_THAT(series.gyro_dps, ElementsAre(0.5, -0.25)) << text;
  }
}

TEST(Layout, MistakesNameFileLineColumnValueAndTheNearest) {
  const std::string text = "# by a logger\nTime[ms],GyrZ,Temp[F]\n0,1,50\n10,x,50\n";
  EXPECT_THAT(refusal(text, layout("t=Time,gyro=GyrY")),
              AllOf(HasSubstr("rec.csv:2"), HasSubstr("'GyrY' is missing"), HasSubstr("'GyrZ'")));
  EXPECT_THAT(refusal(text, layout("t=Time,gyro=GyrZ[dps]")),
              AllOf(HasSubstr("rec.csv:4"), HasSubstr("'GyrZ'"), HasSubstr("'x'")));
  EXPECT_THAT(refusal(text, layout("t=Time,giro=GyrZ")),
              AllOf(HasSubstr("--columns"), HasSubstr("'giro'"), HasSubstr("'gyro'")));
  EXPECT_THAT(refusal(text, layout("t=Time,gyro=GyrZ", "gyro=rads/s")),
              AllOf(HasSubstr("'rads/s'"), HasSubstr("'rad/s'"), HasSubstr("mdps")));
  EXPECT_THAT(refusal(text, layout("t=Time,gyro=GyrZ[dps]", "heading=deg")),
              HasSubstr("'heading_deg'"));
  EXPECT_THAT(refusal("Time[min.],w\n0,1\n", layout("t=Time,gyro=w[dps]")),
              AllOf(HasSubstr("rec.csv:1"), HasSubstr("'min.'"), HasSubstr("'min'")));
  EXPECT_THAT(refusal("w [dps],w [rad/s],t_s\n0,1,2\n", layout("gyro=w")),
              AllOf(HasSubstr("w [dps]"), HasSubstr("w [rad/s]")));
  EXPECT_THAT(refusal("t_s,gyro_dps\n0,0,5\n"), HasSubstr("3 cells"));
  EXPECT_THAT(refusal(text, layout("t=Time,gyro=GyrZ[dps],temp=GyrZ[F]")), HasSubstr("missing"));
}

TEST(Layout, ValuesOutOfRangeAreToldInTheFilesOwnUnit) {
  EXPECT_THAT(refusal("t_s,gyro_dps,T\ns,dps,F\n0,1,-500\n", layout("temp=T")),
              AllOf(HasSubstr("rec.csv:3"), HasSubstr("'T'"), HasSubstr("'-500'"),
                    HasSubstr("-459.67 to 1832 F")));
  EXPECT_THAT(refusal("ms,gyro_dps\n20,1\n10,1\n", layout("t=ms[ms]")),
              AllOf(HasSubstr("rec.csv:3"), HasSubstr("'10' does not come after '20'")));
}

TEST(Layout, AssignmentsAreCheckedOnTheCommandLine) {
  for (const char* text : {"t", "t=", "=Time", "t=a,,gyro=b", "t=a,t=b"})
    EXPECT_THROW(parse_assignments(text, "--columns"), InputError) << text;
  EXPECT_THAT(parse_assignments("", "--columns"), IsEmpty());
}

TEST(Layout, EveryVerbAndAStudyReadALoggersFile) {
  const TestFolder folder;
  std::string standard = "t_s,gyro_dps,temperature_C\n",
              logger = "% logger\nTime (ms);GyrZ;Temp\nms;mdps;F\n";
  for (int i = 0; i < 3000; ++i) {
    const auto rate_mdps = std::lround(100 * std::sin(1e4 * std::sin(i + 1.0)));
    standard +=
        fmt::format("{},{},{}\n", 20 * i / 1000.0, static_cast<double>(rate_mdps) / 1000.0, 25);
    logger += fmt::format("{};{};{}\n", 20 * i, rate_mdps, 77);
  }
  folder.write("standard.csv", standard);
  folder.write("logger.csv.gz", gzipped(logger));
  const std::vector<std::string> mapping = {"--columns", "t=Time,gyro=GyrZ,temp=Temp"};

  for (const char* verb : {"fit", "allan", "apply", "diagnose"}) {
    const auto expected = run_program(folder, {verb, "standard.csv", "--format", "json"});
    const auto got =
        run_program(folder, {verb, "logger.csv.gz", mapping[0], mapping[1], "--format", "json"});
    EXPECT_EQ(got.exit_code, 0) << verb << got.err;
    auto names = got.out;
    for (std::size_t at; (at = names.find("logger.csv.gz")) != names.npos;)
      names.replace(at, 13, "standard.csv");
    EXPECT_EQ(names, expected.out) << verb;
    EXPECT_THAT(
        got.err,
        HasSubstr("Time (ms) as t_s in ms, GyrZ as gyro_dps in mdps, Temp as temperature_C in F"));
  }
  const auto study = [&](const std::string& source) {
    folder.write(
        "s.json",
        R"({"cells": [{"trials": 2, "filters": ["none", "kf"], "scenario": {"duration_s": 10,
        "from_recording": )" +
            source + "}}]}");
    const auto ran = run_program(folder, {"run", "s.json", "--set-aside", "--format", "json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.out;
  };
  EXPECT_EQ(
      study(
          R"({"file": "logger.csv.gz", "columns": {"t": "Time", "gyro": "GyrZ", "temp": "Temp"}})"),
      study(R"({"file": "standard.csv"})"));
}

TEST(MatFile, ReadsWhatItWrites) {
  const TestFolder folder;
  Series series;
  for (int i = 0; i < 500; ++i) {
    series.t_s.push_back(i / 3.0);
    series.gyro_dps.push_back(std::ldexp(std::sin(i), -i));
    series.heading_deg.push_back(i % 7 == 0 ? std::nan("") : 180 * std::cos(i));
  }
  const auto path = folder.path() / "rec.mat";
  write_series(path, series);
  const auto again = read_recording(path);
  EXPECT_EQ(again.series.t_s, series.t_s);
  EXPECT_EQ(again.series.gyro_dps, series.gyro_dps);
  EXPECT_THAT(again.series.heading_deg,
              testing::Pointwise(testing::NanSensitiveDoubleEq(), series.heading_deg));
  EXPECT_THAT(again.series.temperature_C, IsEmpty());
  const auto bytes = folder.read("rec.mat");
  write_series(path, series);
  EXPECT_EQ(folder.read("rec.mat"), bytes);
}

TEST(MatFile, MistakesAreOneLineWithTheRow) {
  const TestFolder folder;
  const auto refused = [&](const std::vector<CsvColumn>& columns) -> std::string {
    try {
      write_columns(folder.path() / "rec.mat", columns);
      read_recording(folder.path() / "rec.mat");
    } catch (const InputError& mistake) {
      return mistake.what();
    }
    return "no error";
  };
  const std::vector<double> up = {0, 1, 2}, back = {0, 2, 1}, two = {0, 1},
                            infinite = {INFINITY, -INFINITY, INFINITY};
  EXPECT_THAT(refused({{"t_s", back, {}}, {"gyro_dps", up, {}}}),
              AllOf(HasSubstr("rec.mat: row 3"), HasSubstr("'t_s'")));
  EXPECT_THAT(refused({{"t_s", up, {}}, {"gyro_dps", two, {}}}),
              AllOf(HasSubstr("'gyro_dps' has 2 values"), HasSubstr("'t_s' has 3")));
  EXPECT_THAT(refused({{"t_s", up, {}}, {"gyro_dps", infinite, {}}}),
              AllOf(HasSubstr("blank throughout"), HasSubstr("'gyro_dps'")));
  EXPECT_THAT(refused({{"t_s", up, {}}, {"gyr_dps", up, {}}}),
              AllOf(HasSubstr("'gyro_dps' is missing"), HasSubstr("'gyr_dps'")));
  EXPECT_THAT(refused({{"t_s", up, {}}, {"stf_1.05", up, {}}, {"stf_1_05", up, {}}}),
              HasSubstr("stands twice"));
}

}  // namespace
}  // namespace gyrostat::layout_test
