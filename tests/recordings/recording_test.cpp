#include <gyrostat/recordings/recording.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/write_columns.hpp>
#include <gyrostat/tests/places.hpp>

namespace gyrostat::recording_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A fresh directory for a test's files.
struct Folder {
  fs::path path = fs::path(testing::TempDir()) / ("gyrostat_recording_" + std::to_string(getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }

  fs::path file(const std::string& name, const std::string& contents) const {
    std::ofstream(path / name, std::ios::binary) << contents;
    return path / name;
  }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(path), fs::directory_iterator());
  }
};

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  bits.reserve(values.size());
  for (const double value : values) {
    bits.push_back(std::isnan(value) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

void expect_same_bits(const Series& a, const Series& b) {
  for (const auto& channel : channels) {
    EXPECT_EQ(bits_of(a.*channel.values), bits_of(b.*channel.values)) << channel.name;
  }
}

template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

Series wide_range_series() {
  Series series;
  for (int i = 0; i < 1000; ++i) {
    series.t_s.push_back(i / 3.0);
    series.gyro_dps.push_back(std::ldexp(std::sin(i * std::numbers::e), -i));
    series.temperature_C.push_back(20 + std::log1p(i));
    series.heading_deg.push_back(i % 7 == 0 ? std::nan("") : 180 * std::cos(i));
    series.mag_valid.push_back(i % 2);
    series.acc_z_mps2.push_back(i % 2 == 0 ? -0.0 : std::numeric_limits<double>::denorm_min());
  }
  return series;
}

TEST(Recording, ColumnsComeInAnyOrder) {
  const Folder folder;
  const auto recording = read_recording(folder.file(
      "a.csv", "mag_valid,note,gyro_dps,t_s\n1,whatever,0.5,0\n0,,-1e-3,0.01\n,x y,,0.02\n"));
  EXPECT_THAT(recording.series.t_s, ElementsAre(0, 0.01, 0.02));
  EXPECT_THAT(recording.series.gyro_dps,
              ElementsAre(0.5, -1e-3, testing::NanSensitiveDoubleEq(NAN)));
  EXPECT_THAT(recording.series.mag_valid, ElementsAre(1, 0, testing::NanSensitiveDoubleEq(NAN)));
  EXPECT_THAT(recording.series.temperature_C, IsEmpty());
  EXPECT_THAT(recording.ignored_columns, ElementsAre("note"));
  EXPECT_EQ(recording.axis, "");
}

TEST(Recording, TheAxisChoosesTheGyro) {
  const Folder folder;
  const auto path = folder.file("a.csv", "t_s,gyro_x_dps,gyro_z_dps\n0,1,3\n1,10,30\n");
  const auto z = read_recording(path, "z");
  EXPECT_THAT(z.series.gyro_dps, ElementsAre(3, 30));
  EXPECT_EQ(z.axis, "z");
  EXPECT_THAT(z.ignored_columns, IsEmpty());
  EXPECT_THAT(error_of([&] { read_recording(path); }),
              AllOf(HasSubstr("a.csv:1"), HasSubstr("--axis"), HasSubstr("'x', 'z'")));
  for (const char* axis : {"y", "w"}) {
    EXPECT_THAT(error_of([&] { read_recording(path, axis); }),
                AllOf(HasSubstr("a.csv:1"), HasSubstr("--axis '" + std::string(axis) + "'"),
                      HasSubstr("allowed: 'x', 'z'")));
  }
}

TEST(Recording, TellsTheAxesThatItHas) {
  const Folder folder;
  const auto axes = [&](const char* columns) {
    return gyro_axes(folder.file("a.csv", std::string("t_s,") + columns + "\n"));
  };
  EXPECT_THAT(axes("gyro_x_dps,gyro_z_dps"), ElementsAre("x", "z"));
  EXPECT_THAT(axes("gyro_y_dps"), ElementsAre("y"));
  EXPECT_THAT(axes("gyro_dps,temperature_C"), ElementsAre(""));
  EXPECT_THAT(error_of([&] { axes("rate"); }), HasSubstr("gyro_dps"));
  EXPECT_THAT(error_of([&] { read_recording(folder.file("b.csv", "t_s,gyro_x_dps\n"), "all"); }),
              AllOf(HasSubstr("b.csv:1"), HasSubstr("--axis 'x'")));
}

TEST(Recording, TheOtherGyrosAreTheRatesAboutTheOtherAxes) {
  const Folder folder;
  const auto path =
      folder.file("a.csv", "gyro_z_dps,t_s,gyro_x_dps,gyro_y_dps\n3,0,1,2\n30,1,10,20\n");
  const auto expect = [&](const char* axis, double own, double first, double second) {
    const auto series = read_recording(path, axis).series;
    EXPECT_THAT(series.gyro_dps, ElementsAre(own, 10 * own)) << axis;
    EXPECT_THAT(series.cross_rate_1_dps, ElementsAre(first, 10 * first)) << axis;
    EXPECT_THAT(series.cross_rate_2_dps, ElementsAre(second, 10 * second)) << axis;
  };
  expect("x", 1, 2, 3);
  expect("y", 2, 3, 1);
  expect("z", 3, 1, 2);
  const auto two =
      read_recording(folder.file("b.csv", "t_s,gyro_x_dps,gyro_z_dps\n0,1,3\n"), "z").series;
  EXPECT_THAT(two.cross_rate_1_dps, ElementsAre(1));
  EXPECT_THAT(two.cross_rate_2_dps, IsEmpty());
}

TEST(Recording, AGyroBesideThoseOfOtherAxesTurnsAboutTheOneThatIsLeft) {
  const Folder folder;
  const auto z =
      read_recording(folder.file("a.csv", "t_s,gyro_dps,gyro_y_dps,gyro_x_dps\n0,3,2,1\n"));
  EXPECT_EQ(z.axis, "");
  EXPECT_THAT(z.series.gyro_dps, ElementsAre(3));
  EXPECT_THAT(z.series.cross_rate_1_dps, ElementsAre(1));
  EXPECT_THAT(z.series.cross_rate_2_dps, ElementsAre(2));
  const auto y =
      read_recording(folder.file("b.csv", "t_s,gyro_dps,gyro_z_dps,gyro_x_dps\n0,2,3,1\n")).series;
  EXPECT_THAT(y.cross_rate_1_dps, ElementsAre(3));
  EXPECT_THAT(y.cross_rate_2_dps, ElementsAre(1));
  const auto alone = read_recording(folder.file("c.csv", "t_s,gyro_dps\n0,2\n")).series;
  EXPECT_THAT(alone.cross_rate_1_dps, IsEmpty());
}

/// A table of three axes: each gyro has its own reference, and across it turn the others'.
TEST(Recording, EachAxisHasItsOwnReference) {
  const Folder folder;
  const auto path = folder.file("a.csv",
                                "t_s,gyro_x_dps,gyro_y_dps,gyro_z_dps,rate_ref_x_dps,"
                                "rate_ref_y_dps,rate_ref_z_dps\n0,1,2,3,10,20,30\n");
  const auto y = read_recording(path, "y").series;
  EXPECT_THAT(y.gyro_dps, ElementsAre(2));
  EXPECT_THAT(y.rate_ref_dps, ElementsAre(20));
  EXPECT_THAT(y.cross_rate_1_dps, ElementsAre(30));
  EXPECT_THAT(y.cross_rate_2_dps, ElementsAre(10));
}

TEST(Recording, RatesAboutTheOtherAxesOfTheirOwnComeFirst) {
  const Folder folder;
  const auto series =
      read_recording(folder.file("a.csv", "t_s,gyro_x_dps,gyro_y_dps,cross_rate_1_dps\n0,1,2,7\n"),
                     "x")
          .series;
  EXPECT_THAT(series.cross_rate_1_dps, ElementsAre(7));
  EXPECT_THAT(series.cross_rate_2_dps, IsEmpty());
}

TEST(Recording, TheOnlyAxisNeedsNoChoice) {
  const Folder folder;
  const auto recording = read_recording(folder.file("a.csv", "t_s,gyro_y_dps\n0,1\n"));
  EXPECT_THAT(recording.series.gyro_dps, ElementsAre(1));
  EXPECT_EQ(recording.axis, "y");
}

TEST(Recording, OtherDialectsReadTheSame) {
  const Folder folder;
  const auto plain = read_recording(folder.file("a.csv", "t_s,gyro_dps\n0,1.5\n0.5,-2\n"));
  for (const std::string text : {
           "\xef\xbb\xbft_s,gyro_dps\r\n0,1.5\r\n0.5,-2\r\n",
           "t_s,gyro_dps\n0,1.5\n0.5,-2\n\n \n\r\n",
           "t_s,gyro_dps\n0,1.5\n0.5,-2",
           " t_s, gyro_dps\n 0, +1.5\n 5e-1, -2.0 \n",
       }) {
    expect_same_bits(read_recording(folder.file("b.csv", text)).series, plain.series);
  }
}

TEST(Recording, AColumnOfBlanksIsAbsent) {
  const Folder folder;
  const auto recording =
      read_recording(folder.file("a.csv", "t_s,gyro_dps,temperature_C\n0,1,\n1,2,\n"));
  EXPECT_THAT(recording.series.temperature_C, IsEmpty());
}

struct BadText {
  std::string name, text;
  std::vector<std::string> said;
};

class BadRecording : public testing::TestWithParam<BadText> {};

TEST_P(BadRecording, IsOneLineThatSaysWhatIsWrong) {
  const Folder folder;
  for (const bool packed : {false, true}) {
    const auto path = folder.file(
        "bad.csv", packed && !GetParam().text.empty() ? gzipped(GetParam().text) : GetParam().text);
    const auto message = error_of([&] { read_recording(path); });
    EXPECT_THAT(message, AllOf(HasSubstr("bad.csv"), Not(HasSubstr("\n"))));
    for (const auto& part : GetParam().said) EXPECT_THAT(message, HasSubstr(part));
  }
}

const std::string head = "t_s,gyro_dps,heading_deg,temperature_C,mag_valid\n";

INSTANTIATE_TEST_SUITE_P(
    Each, BadRecording,
    testing::Values(
        BadText{"Empty", "", {"is empty", "allowed"}},
        BadText{"HeaderOnly", head, {":2: no samples", "required"}},
        BadText{"Binary", std::string("t_s\0gyro", 8), {"not text", "byte 3"}},
        BadText{"Word", head + "0,abc,,,\n", {":2:", "'gyro_dps'", "'abc'", "allowed: finite"}},
        BadText{"TwoPoints", head + "0,1.2.3,,,\n", {":2:", "'gyro_dps'", "'1.2.3'", "allowed"}},
        BadText{"TwoSigns", head + "0,+-1,,,\n", {":2:", "'gyro_dps'", "'+-1'", "allowed"}},
        BadText{"NearlyNan", head + "0,1,,,\n1,nano,,,\n", {":3:", "'gyro_dps'", "'nano'", "NaN"}},
        BadText{
            "Infinite", head + "0,inf,,,\n1,-inf,,,\n", {":1:", "'gyro_dps'", "blank throughout"}},
        BadText{"Overflow", head + "0,1e999,,,\n", {":2:", "'gyro_dps'", "'1e999'", "finite"}},
        BadText{"BlankTime", head + "0,1,,,\n,2,,,\n", {":3:", "'t_s'", "''", "allowed: a time"}},
        BadText{"RepeatedTime",
                head + "0,1,,,\n0.5,1,,,\n0.5,1,,,\n",
                {":4:", "'t_s'", "'0.5' does not come after '0.5'", "allowed: increasing"}},
        BadText{"BackwardTime", head + "0,1,,,\n-1,1,,,\n", {":3:", "'-1'", "after '0'"}},
        BadText{
            "FewCells", head + "0,1,,,\n1,2\n2,1,,,\n", {":3:", "'1,2'", "2 cells", "allowed: 5"}},
        BadText{"ManyCells", head + "0,1,,,,9\n", {":2:", "'0,1,,,,9'", "6 cells", "allowed: 5"}},
        BadText{"TruncatedLastLine", head + "0,1,,,\n1,2,", {":3:", "'1,2,'", "3 cells"}},
        BadText{"BlankLine", head + "0,1,,,\n\n1,1,,,\n", {":3:", "is blank", "allowed"}},
        BadText{"Heading",
                head + "0,1,400.5,,\n",
                {":2:", "'heading_deg'", "'400.5'", "allowed: -180 to 360 deg"}},
        BadText{"Temperature",
                head + "0,1,,-300,\n",
                {":2:", "'temperature_C'", "'-300'", "allowed: -273.15 to 1000"}},
        BadText{"Flag",
                head + "0,1,,,0\n1,1,,,0.5\n",
                {":3:", "'mag_valid'", "'0.5'", "allowed: 0 or 1"}},
        BadText{"Rate", "t_s,gyro_x_dps\n0,-2e5\n", {":2:", "'gyro_x_dps'", "'-200000'", "100000"}},
        BadText{"NoTime", "time_s,gyro_dps\n0,1\n", {":1:", "'t_s' is missing", "'time_s'?"}},
        BadText{"NoGyro", "t_s,girodps,b\n0,1,2\n", {":1:", "'gyro_dps' is missing", "'girodps'?"}},
        BadText{"Bars", "t_s|gyro_dps\n0|1\n", {":1:", "'t_s' is missing", "comma"}},
        BadText{"Twice", "t_s,gyro_dps,a,a\n0,1,2,3\n", {":1:", "'a' appears twice", "allowed"}},
        BadText{"BlankGyro", "t_s,gyro_x_dps\n0,\n1,\n", {":1:", "'gyro_x_dps'", "required"}},
        BadText{"Escape", head + "0,\x1b[31m,,,\n", {":2:", "'?[31m'"}},
        BadText{"LongCell",
                head + "0," + std::string(10'000, 'x') + ",,,\n",
                {":2:", "'" + std::string(40, 'x') + "...'"}}),
    [](const auto& instance) { return instance.param.name; });

/// A compass counts clockwise, and a gyro that points up does not.
TEST(Recording, AHeadingThatTurnsAgainstTheGyroIsTurnedRound) {
  std::string clockwise = "t_s,gyro_dps,heading_deg\n", alike = clockwise, still = clockwise;
  for (int i = 0; i < 1200; ++i) {
    const double t_s = 0.05 * i, rate = 30.0 * std::sin(0.2 * t_s);
    const double turned = 150.0 * (1.0 - std::cos(0.2 * t_s)), noise = i % 3 - 1;
    const auto row = [&](double gyro, double heading) {
      return fmt::format("{},{},{}\n", t_s, gyro, std::fmod(720.0 + heading, 360.0));
    };
    clockwise += row(rate, -turned + noise);
    alike += row(rate, turned + noise);
    still += row(0.1 * noise, 50.0 - noise);
  }
  const Folder folder;
  const auto read = [&](const std::string& text) {
    return read_recording(folder.file("a.csv", text).string());
  };
  const auto turned_round = read(clockwise), as_it_was = read(alike), at_rest = read(still);
  EXPECT_THAT(turned_round.notes, Contains(HasSubstr("turns against the gyro")));
  EXPECT_THAT(as_it_was.notes, IsEmpty());
  EXPECT_THAT(at_rest.notes, IsEmpty());
  for (std::size_t i = 0; i < 1200; ++i) {
    const double noise = static_cast<double>(i % 3) - 1.0;
    EXPECT_NEAR(wrap_degrees(turned_round.series.heading_deg[i] - as_it_was.series.heading_deg[i] +
                             2.0 * noise),
                0.0, 1e-9);
  }
}

TEST(Recording, AMissingFileIsNamed) {
  EXPECT_THAT(error_of([] { read_recording("/nowhere/a.csv"); }),
              AllOf(HasSubstr("/nowhere/a.csv"), HasSubstr("No such file")));
}

TEST(Recording, ADirectoryIsNamedAsSuch) {
  const Folder folder;
  EXPECT_THAT(error_of([&] { read_recording(folder.path); }),
              AllOf(HasSubstr(folder.path.string()), HasSubstr("directory"), HasSubstr("allowed")));
}

TEST(Recording, ATruncatedGzipIsNamedAsSuch) {
  const Folder folder;
  write_series(folder.path / "whole.csv.gz", wide_range_series());
  const auto whole = bytes_of(folder.path / "whole.csv.gz");
  for (const std::size_t kept :
       {std::size_t{2}, std::size_t{12}, whole.size() / 2, whole.size() - 9, whole.size() - 1}) {
    const auto path = folder.file("cut.csv.gz", whole.substr(0, kept));
    EXPECT_THAT(error_of([&] { read_recording(path); }),
                AllOf(HasSubstr("cut.csv.gz"), HasSubstr("truncated")))
        << kept << " bytes";
  }
}

TEST(Recording, ACorruptGzipIsNamedAsSuch) {
  const Folder folder;
  write_series(folder.path / "whole.csv.gz", wide_range_series());
  const auto whole = bytes_of(folder.path / "whole.csv.gz");
  for (const std::size_t at : {std::size_t{2}, whole.size() / 2, whole.size() - 8}) {
    auto bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    const auto path = folder.file("flipped.csv.gz", bytes);
    EXPECT_THAT(error_of([&] { read_recording(path); }),
                AllOf(HasSubstr("flipped.csv.gz"), HasSubstr("corrupt")))
        << "byte " << at;
  }
}

TEST(Recording, WhatIsWrittenIsReadToTheSameBits) {
  const Folder folder;
  const auto series = wide_range_series();
  for (const char* name : {"a.csv", "a.csv.gz"}) {
    write_series(folder.path / name, series);
    const auto recording = read_recording(folder.path / name);
    expect_same_bits(recording.series, series);
    EXPECT_THAT(recording.ignored_columns, IsEmpty());
  }
  EXPECT_TRUE(bytes_of(folder.path / "a.csv").starts_with("t_s,gyro_dps,"));
  EXPECT_TRUE(bytes_of(folder.path / "a.csv.gz").starts_with("\x1f\x8b"));
  EXPECT_EQ(folder.files(), 2);
}

TEST(Recording, AGzipOfSeveralMembersIsTheirConcatenation) {
  const Folder folder;
  const auto path = folder.file("a.csv.gz", gzipped("t_s,gyro_dps\n0,1\n1,") + gzipped("2\n"));
  EXPECT_THAT(read_recording(path).series.gyro_dps, ElementsAre(1, 2));
}

TEST(RequireUniform, NamesTheFirstIntervalThatIsOff) {
  Series series;
  series.t_s = {0, 0.01, 0.0205, 0.0305, 0.0425, 0.0525};
  const auto message = error_of([&] { require_uniform(series, "a.csv"); });
  EXPECT_THAT(message, AllOf(HasSubstr("a.csv:6:"), HasSubstr("'0.0425'"), HasSubstr("0.012 s"),
                             HasSubstr("allowed: 0.01 s"), HasSubstr("1 of 5")));
  series.t_s[4] = 0.0405;
  series.t_s.pop_back();
  EXPECT_NO_THROW(require_uniform(series, "a.csv"));
}

TEST(WriteCsv, QuotesTextsAndLeavesNoValueBlank) {
  const Folder folder;
  const std::vector<double> values = {0.1, std::nan("")};
  const std::vector<std::string_view> texts = {"plain", "a \"b\", c"};
  const std::vector<CsvColumn> columns = {{"value", values, {}}, {"text", {}, texts}};
  write_csv(folder.path / "a.csv", columns);
  EXPECT_EQ(bytes_of(folder.path / "a.csv"),
            "value,text\n0.10000000000000001,plain\n,\"a \"\"b\"\", c\"\n");
}

/// No file can grow beyond `bytes` while this lives, as on a full disk.
struct FullDisk {
  rlimit before{};
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit full{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
  }
};

TEST(WriteAtomically, AFailingWriteLeavesThePreviousFile) {
  const Folder folder;
  const auto path = folder.path / "a.csv";
  write_atomically(path, "previous");
  const auto message = error_of([&] {
    const FullDisk disk(1000);
    write_atomically(path, std::string(100'000, 'x'));
  });
  EXPECT_THAT(message, AllOf(HasSubstr("a.csv"), HasSubstr("File too large")));
  EXPECT_EQ(bytes_of(path), "previous");
  EXPECT_EQ(folder.files(), 1);
}

TEST(WriteAtomically, AFailingRenameLeavesNothingBehind) {
  const Folder folder;
  EXPECT_THAT(error_of([&] { write_atomically(folder.path / "none" / "a.csv", "x"); }),
              HasSubstr("No such file"));
  fs::create_directory(folder.path / "taken");
  EXPECT_THAT(error_of([&] { write_atomically(folder.path / "taken", "x"); }),
              AllOf(HasSubstr("taken"), HasSubstr("directory")));
  EXPECT_EQ(folder.files(), 1);
}

TEST(WriteAtomically, ASymbolicLinkIsFollowed) {
  const Folder folder;
  const auto path = folder.file("a.csv", "previous");
  fs::create_symlink("a.csv", folder.path / "link");
  write_atomically(folder.path / "link", "next");
  EXPECT_EQ(bytes_of(path), "next");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
}

struct Real {
  std::string name, axis;
  std::size_t rows;
  std::ptrdiff_t missing_headings;
  bool uniform;
};

class RealRecording : public testing::TestWithParam<Real> {};

TEST_P(RealRecording, IsReadWhole) {
  const auto path = fs::path(places::recordings()) / (GetParam().name + ".csv.gz");
  if (!fs::exists(path)) {
    GTEST_SKIP() << path << " is absent; GYROSTAT_RECORDINGS names the folder of recordings";
  }
  const auto recording = read_recording(path, GetParam().axis);
  const auto& series = recording.series;
  for (const auto& channel : channels) {
    const auto& values = series.*channel.values;
    EXPECT_TRUE(values.empty() || values.size() == series.size()) << channel.name;
  }
  EXPECT_EQ(series.size(), GetParam().rows);
  EXPECT_EQ(std::ranges::count_if(series.heading_deg, [](double h) { return std::isnan(h); }),
            GetParam().missing_headings);
  const auto message = error_of([&] { require_uniform(series, path.string()); });
  EXPECT_THAT(message, GetParam().uniform ? HasSubstr("no error") : HasSubstr("median interval"));
}

INSTANTIATE_TEST_SUITE_P(Each, RealRecording,
                         testing::Values(Real{"mtig_static_a", "", 200'000, 0, true},
                                         Real{"adis16405_static_1", "z", 360'000, 0, true},
                                         Real{"mpu6050_static", "z", 65'067, 16'429, true},
                                         Real{"mpu6050_static_bursty", "z", 65'067, 16'429, false},
                                         Real{"mpu6050_turning", "z", 2'393, 604, false},
                                         Real{"cubesat_cooldown", "x", 6'250, 0, false}),
                         [](const auto& instance) { return instance.param.name; });

TEST(RealRecordings, AllAreEvenOrNameTheRemedy) {
  if (!fs::exists(fs::path(places::recordings())))
    GTEST_SKIP() << fs::path(places::recordings())
                 << " is absent; GYROSTAT_RECORDINGS names the folder of recordings";
  std::size_t even = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(places::recordings()))) {
    const auto name = entry.path().filename().string();
    if (!entry.is_regular_file() || name.ends_with(".md")) continue;
    const bool one_axis = name.starts_with("broad_01") || name.starts_with("broad_32");
    auto recording = read_recording(entry.path(), one_axis                   ? ""
                                                  : name.starts_with("mtig") ? "x"
                                                                             : "z");
    const auto message = error_of([&] { make_even(recording, name); });
    if (message == "no error") {
      ++even;
      EXPECT_NO_THROW(require_uniform(recording.series, name)) << name;
      continue;
    }
    EXPECT_THAT(message, HasSubstr("--resample ")) << name;
    RecordingLayout layout;
    layout.resample_hz = std::stod(message.substr(message.find("--resample ") + 11));
    recording = read_recording(entry.path(), "z");
    make_even(recording, name, layout);
    EXPECT_NO_THROW(require_uniform(recording.series, name)) << name;
  }
  EXPECT_GE(even, 18u);
}

TEST(RealRecordings, AFlightLogHoldsWhatWasConvertedFromIt) {
  if (!fs::exists(fs::path(places::recordings()) / "px4_auav_x21.ulg"))
    GTEST_SKIP()
        << "px4_auav_x21.ulg is absent; GYROSTAT_RECORDINGS names the folder of recordings";
  const auto log = read_recording(fs::path(places::recordings()) / "px4_auav_x21.ulg", "z");
  const auto part =
      read_recording(fs::path(places::recordings()) / "px4_auav_x21_static.csv.gz", "z");
  const auto& whole = log.series.gyro_dps;
  const auto& some = part.series.gyro_dps;
  const auto near = [](double a, double b) { return std::abs(a - b) < 1e-6; };
  const auto found = std::search(whole.begin(), whole.end(), some.begin(), some.begin() + 20, near);
  ASSERT_NE(found, whole.end());
  ASSERT_GE(whole.end() - found, std::ssize(some));
  const auto first = static_cast<std::size_t>(found - whole.begin());
  for (std::size_t i = 0; i < some.size(); ++i) {
    ASSERT_NEAR(whole[first + i], some[i], 1e-6) << i;
    ASSERT_NEAR(log.series.t_s[first + i] - log.series.t_s[first],
                part.series.t_s[i] - part.series.t_s[0], 2e-6)
        << i;
  }
}

}  // namespace
}  // namespace gyrostat::recording_test
