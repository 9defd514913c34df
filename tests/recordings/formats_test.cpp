// Every format, in files as the programs that write it do.

#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/matlab.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/recordings/write_columns.hpp>
#include <gyrostat/tests/program.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::formats_test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

/// Rows of a text: `row(k)` for each sample.
std::string rows(const std::string& header, const std::function<std::string(int)>& row) {
  std::string text = header + '\n';
  for (int k = 0; k < log_samples; ++k) text += row(k) + '\n';
  return text;
}

std::string rates(int k, const char* between = ",") {
  return fmt::format("{}{}{}{}{}", log_rate(k, 0), between, log_rate(k, 1), between,
                     log_rate(k, 2));
}

struct Written {
  std::string format, name;
  std::function<void(const TestFolder&)> write;
  std::string columns = "", units = "", preset = "";
  double rate_hz = 0.0;
};

Written text(const std::string& format, const std::string& name, const std::string& bytes) {
  return {format, name, [=](const TestFolder& folder) { folder.write(name, bytes); }};
}

std::string euroc() {
  return rows(
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m "
      "s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]",
      [](int k) { return fmt::format("{},{},8.1,-0.3,-2.6", log_time_ns(k), rates(k)); });
}

void write_kitti(const TestFolder& folder) {
  std::string times;
  for (int k = 0; k < log_samples; ++k) {
    times += fmt::format("2011-09-26 13:02:{:02}.{:09}\n", 25 + (96 + k) / 100,
                         (96 + k) % 100 * 10'000'000);
    folder.write(
        fmt::format("drive/oxts/data/{:010}.txt", k),
        fmt::format("49.015 8.434 116.4 0.035 0.0092 -2.7 -9.4 -4.6 10.5 0.02 -0.01 0.1 0.2 9.8 "
                    "0.1 0.2 9.8 {} 0.003 0.005 0.006 0.48 0.08 4 11 6 6 6\n",
                    rates(k, " ")));
  }
  folder.write("drive/oxts/timestamps.txt", times);
}

void write_matlab(const TestFolder& folder) {
  // A struct cannot be written; its fields are read as variables are.
  std::vector<double> x, y, z;
  for (int k = 0; k < log_samples; ++k) {
    x.push_back(log_rate(k, 0));
    y.push_back(log_rate(k, 1));
    z.push_back(log_rate(k, 2));
  }
  const std::vector<CsvColumn> columns = {{"wx", x, {}}, {"wy", y, {}}, {"wz", z, {}}};
  write_mat(folder.path() / "rec.mat", columns);
}

std::vector<Written> files() {
  const auto at_s = [](int k) { return fmt::format("{}", 0.01 * k); };
  std::vector<Written> all = {
      text("euroc", "data.csv", euroc()),
      text(
          "rostopic", "imu.csv",
          rows(
              "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.orientation.x,"
              "field.angular_velocity.x,field.angular_velocity.y,field.angular_velocity.z,"
              "field.angular_velocity_covariance0,field.linear_acceleration.x,"
              "field.linear_acceleration.y,field.linear_acceleration.z",
              [](int k) {
                return fmt::format("{},{},{},imu_link,0.0,{},0.0,0.1,0.2,9.81",
                                   log_time_ns(k) + 7'000'000 * (k % 2), k, log_time_ns(k),
                                   rates(k));
              })),
      text("phyphox", "Gyroscope.csv",
           rows("\"Time (s)\",\"Gyroscope x (rad/s)\",\"Gyroscope y (rad/s)\",\"Gyroscope z "
                "(rad/s)\",\"Absolute (rad/s)\"",
                [&](int k) { return at_s(k) + "," + rates(k) + ",0.0"; })),
      text("phyphox", "Raw Data.csv",
           rows("\"Time (s)\";\"Gyroscope x (rad/s)\";\"Gyroscope y (rad/s)\";\"Gyroscope z "
                "(rad/s)\"",
                [&](int k) {
                  auto row = at_s(k) + ";" + rates(k, ";");
                  std::ranges::replace(row, '.', ',');
                  return row;
                })),
      text("sensor_logger", "Gyroscope.csv",
           rows("time,seconds_elapsed,z,y,x",
                [&](int k) {
                  return fmt::format("{},{},{},{},{}", log_time_ns(k), at_s(k), log_rate(k, 2),
                                     log_rate(k, 1), log_rate(k, 0));
                })),
      text("px4_csv", "log_sensor_combined_0.csv",
           rows("timestamp,gyro_rad[0],gyro_rad[1],gyro_rad[2],gyro_integral_dt,accelerometer_"
                "timestamp_"
                "relative,accelerometer_m_s2[0],accelerometer_m_s2[1],accelerometer_m_s2[2]",
                [&](int k) {
                  return fmt::format("{},{},4000,0,0.1,0.2,-9.81", 10'000 * k + 3, rates(k));
                })),
      text("ardupilot_csv", "IMU.csv",
           rows("timestamp,TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz",
                [&](int k) {
                  return fmt::format(
                      "1700000000.{:02},{},0,{},0.1,0.2,-9.81,0,0,28.8,1,1,1000,1000", k,
                      10'000 * k + 3, rates(k));
                })),
      text("ulog", "log.ulg", ulog_bytes()),
      text("ulog", "fifo.ulg", fifo_ulog_bytes()),
      text("dataflash", "00000001.BIN", dataflash_bytes()),
      {"gnss_ins_sim", "gyro-0.csv",
       [=](const TestFolder& folder) {
         folder.write("time.csv", rows("time (sec)", at_s));
         folder.write("gyro-0.csv", rows("gyro_x (rad/s),gyro_y (rad/s),gyro_z (rad/s)",
                                         [](int k) { return rates(k); }));
       }},
      {"kitti_oxts", "drive", write_kitti},
      {"rosbag2", "bag_0.db3",
       [](const TestFolder& folder) { write_rosbag2((folder.path() / "bag_0.db3").string()); }},
      {"matlab", "rec.mat", write_matlab, "gyro_x=imu.wx,gyro_y=imu.wy,gyro_z=imu.wz", "gyro=rad/s",
       "", 100},
  };
  for (const char* compression : {"", "lz4", "zstd"})
    all.push_back(text("mcap", fmt::format("{}.mcap", compression), mcap_bytes(compression)));
  for (const char* compression : {"none", "bz2", "lz4"})
    all.push_back(text("rosbag", fmt::format("{}.bag", compression), bag_bytes(compression)));
  for (const auto& [name, bytes, columns, units] :
       {std::tuple{"a.npy", npy_bytes(), "1=t,2=gyro_x,3=gyro_y,4=gyro_z", "gyro=rad/s"},
        std::tuple{"r.npy", record_npy_bytes(), "t=stamp,gyro_x=w(:,1),gyro_y=w(:,2),gyro_z=w(:,3)",
                   "t=ns,gyro=rad/s"},
        std::tuple{"a.npz", npz_bytes(), "gyro_x=gyro(:,1),gyro_y=gyro(:,2),gyro_z=gyro(:,3),t=t",
                   "gyro=rad/s"}}) {
    auto one = text("numpy", name, bytes);
    one.columns = columns;
    one.units = units;
    all.push_back(one);
  }
  return all;
}

RecordingLayout layout_of(const Written& file) {
  RecordingLayout layout;
  layout.columns = parse_assignments(file.columns, "--columns");
  layout.units = parse_assignments(file.units, "--units");
  layout.preset = file.preset;
  layout.rate_hz = file.rate_hz;
  return layout;
}

TEST(Formats, AreKnownByContentAndReadInTheirUnits) {
  for (const auto& file : files()) {
    const TestFolder folder;
    file.write(folder);
    for (int axis = 0; axis < 3; ++axis) {
      const auto recording =
          read_recording(folder.path() / file.name, std::string(1, "xyz"[axis]), layout_of(file));
      const auto& series = recording.series;
      EXPECT_EQ(recording.format, file.format) << file.name;
      ASSERT_EQ(series.size(), log_samples) << file.name;
      for (std::size_t k = 0; k < series.size(); ++k) {
        const int sample = static_cast<int>(k);
        EXPECT_NEAR(series.t_s[k] - series.t_s[0], 0.01 * sample, 1e-6) << file.name;
        EXPECT_NEAR(series.gyro_dps[k], log_rate(sample, axis) * 180 / std::numbers::pi, 2e-6)
            << file.name << ' ' << k;
      }
    }
  }
}

TEST(Formats, APresetRefusesAnyOtherFileInWords) {
  const TestFolder folder;
  for (const std::string contents : {"ab\n", "t_s,rate\n0,0.1\n0.1,0.2\n0.2,0.1\n"}) {
    folder.write("rec.csv", contents);
    for (const auto& format : format_types()) {
      RecordingLayout layout;
      layout.preset = format.id;
      EXPECT_THROW(read_recording(folder.path() / "rec.csv", "z", layout), InputError)
          << format.id << " of " << contents;
    }
  }
}

TEST(Formats, ASensorThatIsNoGyroIsNotTakenForOne) {
  const TestFolder folder;
  folder.write("Accelerometer.csv", "time,seconds_elapsed,z,y,x\n1,0.01,1,2,3\n2,0.02,1,2,3\n");
  const auto read = [&](const std::string& preset) {
    RecordingLayout layout;
    layout.preset = preset;
    return read_recording(folder.path() / "Accelerometer.csv", "z", layout).series.gyro_dps.front();
  };
  try {
    read("");
    FAIL();
  } catch (const InputError& mistake) {
    EXPECT_THAT(mistake.what(),
                AllOf(HasSubstr("Gyroscope.csv"), HasSubstr("--preset sensor_logger")));
  }
  EXPECT_NEAR(read("sensor_logger"), 180 / std::numbers::pi, 1e-12);
}

TEST(Formats, ALogSaysWhichTopicsItHas) {
  const TestFolder folder;
  folder.write("log.bin", dataflash_bytes());
  const auto first = read_recording(folder.path() / "log.bin", "z");
  EXPECT_THAT(first.notes.front(), AllOf(HasSubstr("topic IMU[0]"), HasSubstr("IMU[1]")));
  EXPECT_NEAR(first.series.temperature_C.front(), 31.5, 1e-6);
  EXPECT_NEAR(first.series.acc_z_mps2.front(), 9.81, 1e-6);
  RecordingLayout layout;
  layout.topic = "IMU[1]";
  const auto second = read_recording(folder.path() / "log.bin", "z", layout);
  EXPECT_NEAR(second.series.gyro_dps.front(), 180 / std::numbers::pi, 1e-5);
  layout.topic = "IMU[7]";
  EXPECT_THROW(read_recording(folder.path() / "log.bin", "z", layout), InputError);
}

TEST(Formats, DataFlashMayBeginWithAnyDescription) {
  constexpr std::size_t first_description = 89;  // that of descriptions themselves
  const TestFolder folder;
  folder.write("log.bin", dataflash_bytes().substr(first_description));
  EXPECT_EQ(read_recording(folder.path() / "log.bin", "z").format, "dataflash");
}

std::string refusal(const std::filesystem::path& path, const RecordingLayout& layout = {}) {
  try {
    read_recording(path, "z", layout);
  } catch (const InputError& mistake) {
    return mistake.what();
  }
  return "no error";
}

TEST(Formats, WhatCannotBeReadIsNamedWithItsConverter) {
  const TestFolder folder;
  for (const auto& [bytes, name, converter] :
       {std::tuple{std::string("PAR1\x15\x04"), "Parquet", "pandas"},
        std::tuple{std::string("ARROW1\0\0", 8), "Arrow", "pandas"},
        std::tuple{std::string("\x89HDF\r\n\x1a\n"), "HDF5", ".mat"},
        std::tuple{std::string("\x28\xb5\x2f\xfd\x04"), "Zstandard", "zstd -d"},
        std::tuple{std::string("PK\x03\x04") + std::string(40, 'x'), "ZIP", "unzip"},
        std::tuple{std::string("SQLite format 3\0 android", 23), "SQLite", "sqlite3"},
        std::tuple{std::string("{\"sensor\": 1}"), "JSON", "CSV"}}) {
    folder.write("log.any", bytes);
    EXPECT_THAT(
        refusal(folder.path() / "log.any"),
        AllOf(HasSubstr("log.any"), HasSubstr(name), HasSubstr(converter), Not(HasSubstr("\n"))));
  }
  RecordingLayout layout;
  layout.preset = "eurok";
  EXPECT_THAT(refusal(folder.path() / "log.any", layout), HasSubstr("'euroc'"));
}

/// The binary ones, whose readers follow what the file says.
std::vector<Written> binaries() {
  std::vector<Written> found;
  for (auto& file : files())
    for (const char* format : {"ulog", "dataflash", "mcap", "rosbag", "rosbag2", "numpy"})
      if (file.format == format) found.push_back(file);
  return found;
}

TEST(Formats, ADamagedLogIsReadAsFarAsItIsWholeOrRefusedInOneLine) {
  std::uint64_t state = 1;
  const auto draw = [&](std::uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % below;
  };
  std::size_t refused = 0, read = 0;
  for (const auto& file : binaries()) {
    const TestFolder folder;
    file.write(folder);
    const auto whole = folder.read(file.name);
    for (int trial = 0; trial < 150; ++trial) {
      auto bytes = whole;
      const auto changes = 1 + draw(3);
      for (std::uint64_t c = 0; c < changes; ++c) {
        const auto at =
            draw(trial % 2 == 0 ? std::min<std::size_t>(bytes.size(), 600) : bytes.size());
        switch (draw(4)) {
          case 0:
            bytes[at] = static_cast<char>(draw(256));
            break;
          case 1:
            bytes.resize(std::max<std::size_t>(at, 8));
            break;
          case 2:  // a huge count
            for (std::size_t i = at; i < std::min(bytes.size(), at + 4); ++i) bytes[i] = '\xff';
            break;
          default:
            bytes.insert(at, bytes.substr(draw(bytes.size()), draw(64)));
        }
        if (bytes.size() < 16) break;
      }
      folder.write(file.name, bytes);
      const auto said = refusal(folder.path() / file.name, layout_of(file));
      EXPECT_THAT(said, Not(HasSubstr("\n"))) << file.name;
      ++(said == "no error" ? read : refused);
    }
  }
  EXPECT_GT(refused, 100u);
  EXPECT_GT(read, 100u);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KiB";
}

TEST(Formats, ABombIsRefusedBeforeItsMemoryIsTaken) {
  const TestFolder folder;
  std::string packed;
  Gzip gzip([&](std::string_view piece) { packed += piece; });
  const std::string row(1 << 20, '\n');
  gzip.write("t_s,gyro_z_dps\n");
  for (int i = 0; i < 100; ++i) gzip.write(row);
  gzip.finish();
  folder.write("bomb.csv.gz", packed);
  EXPECT_THAT(refusal(folder.path() / "bomb.csv.gz"), HasSubstr("100 times its size"));

  LogBytes mcap{std::string("\x89MCAP0\r\n", 8)};
  mcap.number(std::uint8_t{6})
      .number(std::uint64_t{32 + 4 + 4 + 8 - 4})
      .number(std::uint64_t{0})
      .number(std::uint64_t{0});
  mcap.number(std::uint64_t{1} << 40).number(0u).text("zstd").number(std::uint64_t{0});
  folder.write("bomb.mcap", mcap.bytes);
  EXPECT_THAT(refusal(folder.path() / "bomb.mcap"), HasSubstr("allowed: up to 256 MiB"));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KiB";
}

}  // namespace
}  // namespace gyrostat::formats_test
