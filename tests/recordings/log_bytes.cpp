#include <gyrostat/tests/recordings/log_bytes.hpp>

#include <utility>
#include <vector>

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

namespace gyrostat {
namespace {

std::string packed(const std::string& text, const std::string& compression) {
  if (compression == "lz4") {
    std::string out(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
    out.resize(LZ4F_compressFrame(out.data(), out.size(), text.data(), text.size(), nullptr));
    return out;
  }
  if (compression == "zstd") {
    std::string out(ZSTD_compressBound(text.size()), '\0');
    out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), 3));
    return out;
  }
  if (compression == "bz2") {
    auto size = static_cast<unsigned>(text.size() + text.size() / 50 + 600);
    std::string out(size, '\0');
    BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(text.data()),
                             static_cast<unsigned>(text.size()), 9, 0, 0);
    out.resize(size);
    return out;
  }
  return text;
}

void put_body(LogBytes& to, int k) {
  for (int i = 0; i < 4 + 9; ++i) to.number(0.0);
  for (int axis = 0; axis < 3; ++axis) to.number(log_rate(k, axis));
  for (int i = 0; i < 9; ++i) to.number(0.0);
  to.number(0.0).number(0.0).number(9.81);
  for (int i = 0; i < 9; ++i) to.number(0.0);
}

std::string cdr(int k) {
  LogBytes message;
  message.raw(std::string_view("\0\1\0\0", 4));
  message.number(static_cast<std::int32_t>(log_time_ns(k) / 1'000'000'000));
  message.number(static_cast<std::uint32_t>(log_time_ns(k) % 1'000'000'000));
  message.text(std::string_view("imu_link\0", 9)).align(8, 4);
  put_body(message, k);
  return message.bytes;
}

std::string ros1(int k) {
  LogBytes message;
  message.number(static_cast<std::uint32_t>(k));
  message.number(static_cast<std::uint32_t>(log_time_ns(k) / 1'000'000'000));
  message.number(static_cast<std::uint32_t>(log_time_ns(k) % 1'000'000'000));
  message.text("imu_link");
  put_body(message, k);
  return message.bytes;
}

void ulog_message(LogBytes& log, char type, const std::string& body) {
  log.number(static_cast<std::uint16_t>(body.size())).number(type).raw(body);
}

LogBytes ulog_start() {
  LogBytes log;
  log.raw(std::string_view("ULog\x01\x12\x35\x01", 8)).number(std::uint64_t{112500});
  ulog_message(log, 'B', std::string(40, '\0'));
  return log;
}

void mcap_record(LogBytes& to, std::uint8_t opcode, const std::string& body) {
  to.number(opcode).number(static_cast<std::uint64_t>(body.size())).raw(body);
}

void bag_record(LogBytes& to, const std::vector<std::string>& fields, const std::string& data) {
  LogBytes header;
  for (const auto& field : fields) header.text(field);
  to.text(header.bytes).text(data);
}

template <class T>
std::string field(const std::string& name, T value) {
  return LogBytes{name + '='}.number(value).bytes;
}

std::string npy(const std::string& descr, const std::string& shape, const std::string& data) {
  auto header = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}, }}", descr, shape);
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  LogBytes file;
  file.raw(std::string_view("\x93NUMPY\x01\x00", 8));
  file.number(static_cast<std::uint16_t>(header.size())).raw(header).raw(data);
  return file.bytes;
}

}  // namespace

std::string ulog_bytes() {
  auto log = ulog_start();
  ulog_message(
      log, 'F',
      "sensor_combined:uint64_t timestamp;float[3] gyro_rad;uint32_t gyro_integral_dt;int32_t "
      "accelerometer_timestamp_relative;float[3] accelerometer_m_s2;uint32_t "
      "accelerometer_integral_dt;");
  ulog_message(log, 'F', "vehicle_status:uint64_t timestamp;uint8_t state;uint8_t[7] _padding0;");
  ulog_message(log, 'I', LogBytes{}.number(std::uint8_t{13}).raw("char[4] sys_namePX4 ").bytes);
  ulog_message(
      log, 'A',
      LogBytes{}.number(std::uint8_t{0}).number(std::uint16_t{7}).raw("vehicle_status").bytes);
  ulog_message(
      log, 'A',
      LogBytes{}.number(std::uint8_t{0}).number(std::uint16_t{3}).raw("sensor_combined").bytes);
  for (int k = 0; k < log_samples; ++k) {
    ulog_message(
        log, 'D',
        LogBytes{}.number(std::uint16_t{7}).number(std::uint64_t{1}).number(std::uint8_t{2}).bytes);
    LogBytes data;
    data.number(std::uint16_t{3}).number(static_cast<std::uint64_t>(log_time_ns(k) / 1000));
    for (int axis = 0; axis < 3; ++axis) data.number(static_cast<float>(log_rate(k, axis)));
    data.number(std::uint32_t{10000}).number(std::int32_t{0});
    data.number(0.0f).number(0.0f).number(9.81f).number(std::uint32_t{10000});
    ulog_message(log, 'D', data.bytes);
  }
  return log.bytes;
}

std::string fifo_ulog_bytes() {
  auto log = ulog_start();
  ulog_message(
      log, 'F',
      "sensor_gyro_fifo:uint64_t timestamp;uint64_t timestamp_sample;uint32_t device_id;float "
      "dt;float scale;uint8_t samples;int16_t[8] x;int16_t[8] y;int16_t[8] z;");
  ulog_message(
      log, 'A',
      LogBytes{}.number(std::uint8_t{1}).number(std::uint16_t{0}).raw("sensor_gyro_fifo").bytes);
  for (int k = 0; k < log_samples; k += 5) {
    LogBytes data;
    const auto last = static_cast<std::uint64_t>(log_time_ns(k + 4) / 1000);
    data.number(std::uint16_t{0}).number(last + 50).number(last).number(std::uint32_t{1});
    data.number(10000.0f).number(1e-3f).number(std::uint8_t{5});
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 8; ++i)
        data.number(static_cast<std::int16_t>(i < 5 ? (k + i) * (axis + 1) : 0));
    ulog_message(log, 'D', data.bytes);
  }
  return log.bytes;
}

std::string dataflash_bytes() {
  LogBytes log;
  const auto format = [&](std::uint8_t type, std::uint8_t length, std::string_view name,
                          std::string_view letters, std::string_view labels) {
    log.raw("\xa3\x95\x80").number(type).number(length);
    log.padded(name, 4).padded(letters, 16).padded(labels, 64);
  };
  format(128, 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns");
  format(162, 54, "IMU", "QBffffffIIfBBHH",
         "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz");
  format(129, 27, "PARM", "QNf", "TimeUS,Name,Value");
  for (int k = 0; k < log_samples; ++k)
    for (std::uint8_t instance = 0; instance < 2; ++instance) {
      log.raw("\xa3\x95\xa2").number(static_cast<std::uint64_t>(log_time_ns(k) / 1000));
      log.number(instance);
      for (int axis = 0; axis < 3; ++axis)
        log.number(static_cast<float>(log_rate(k, axis) + instance));
      log.number(0.0f).number(0.0f).number(9.81f).number(0u).number(0u).number(31.5f);
      log.raw("\x01\x01").number(std::uint16_t{1000}).number(std::uint16_t{1000});
    }
  return log.bytes;
}

std::string mcap_bytes(const std::string& compression) {
  LogBytes records, log;
  mcap_record(records, 3,
              LogBytes{}
                  .number(std::uint16_t{1})
                  .text("sensor_msgs/msg/Imu")
                  .text("ros2msg")
                  .text("…")
                  .bytes);
  mcap_record(records, 4,
              LogBytes{}
                  .number(std::uint16_t{9})
                  .number(std::uint16_t{1})
                  .text("/imu/data")
                  .text("cdr")
                  .number(0u)
                  .bytes);
  for (int k = 0; k < log_samples; ++k)
    mcap_record(records, 5,
                LogBytes{}
                    .number(std::uint16_t{9})
                    .number(static_cast<std::uint32_t>(k))
                    .number(static_cast<std::uint64_t>(log_time_ns(k) + 1'000'000))
                    .number(static_cast<std::uint64_t>(log_time_ns(k)))
                    .raw(cdr(k))
                    .bytes);
  log.raw(std::string_view("\x89MCAP0\r\n", 8));
  mcap_record(log, 1, LogBytes{}.text("ros2").text("libmcap").bytes);
  const auto chunk = packed(records.bytes, compression);
  mcap_record(log, 6,
              LogBytes{}
                  .number(static_cast<std::uint64_t>(log_time_ns(0)))
                  .number(static_cast<std::uint64_t>(log_time_ns(log_samples - 1)))
                  .number(static_cast<std::uint64_t>(records.bytes.size()))
                  .number(0u)
                  .text(compression)
                  .number(static_cast<std::uint64_t>(chunk.size()))
                  .raw(chunk)
                  .bytes);
  mcap_record(log, 15, LogBytes{}.number(0u).bytes);
  mcap_record(log, 2, std::string(20, '\0'));
  log.raw(std::string_view("\x89MCAP0\r\n", 8));
  return log.bytes;
}

std::string bag_bytes(const std::string& compression) {
  LogBytes records, log;
  const std::vector<std::string> connection = {field("op", std::uint8_t{7}), field("conn", 2u),
                                               "topic=/imu"};
  LogBytes described;
  for (const char* each : {"topic=/imu", "type=sensor_msgs/Imu",
                           "md5sum=6a62c6daae103f4ff57a132d6f95cec2", "message_definition=…"})
    described.text(each);
  bag_record(records, connection, described.bytes);
  for (int k = 0; k < log_samples; ++k) {
    auto time = field("time", static_cast<std::uint32_t>(log_time_ns(k) / 1'000'000'000));
    time += LogBytes{}.number(static_cast<std::uint32_t>(log_time_ns(k) % 1'000'000'000)).bytes;
    bag_record(records, {field("op", std::uint8_t{2}), field("conn", 2u), time}, ros1(k));
  }
  log.raw("#ROSBAG V2.0\n");
  bag_record(log,
             {field("op", std::uint8_t{3}), field("index_pos", std::uint64_t{0}),
              field("conn_count", 1u), field("chunk_count", 1u)},
             std::string(4000, ' '));
  bag_record(log,
             {field("op", std::uint8_t{5}), "compression=" + compression,
              field("size", static_cast<std::uint32_t>(records.bytes.size()))},
             packed(records.bytes, compression));
  bag_record(
      log, {field("op", std::uint8_t{4}), field("ver", 1u), field("conn", 2u), field("count", 0u)},
      "");
  bag_record(log, connection, described.bytes);
  return log.bytes;
}

std::string npy_bytes() {
  LogBytes data;
  for (int k = 0; k < log_samples; ++k) {
    data.number(0.01 * k);
    for (int axis = 0; axis < 3; ++axis) data.number(log_rate(k, axis));
  }
  return npy("'<f8'", fmt::format("({}, 4)", log_samples), data.bytes);
}

std::string record_npy_bytes() {
  LogBytes data;
  for (int k = 0; k < log_samples; ++k) {
    data.number(static_cast<std::int64_t>(10'000'000) * k);
    for (int axis = 0; axis < 3; ++axis) data.number(static_cast<float>(log_rate(k, axis)));
  }
  return npy("[('stamp', '<i8'), ('w', '<f4', (3,))]", fmt::format("({},)", log_samples),
             data.bytes);
}

std::string npz_bytes() {
  LogBytes times, rates, archive, directory;
  for (int k = 0; k < log_samples; ++k) {
    times.number(0.01 * k);
    for (int axis = 0; axis < 3; ++axis) rates.number(log_rate(k, axis));
  }
  std::uint16_t entries = 0;
  for (const auto& [name, array] :
       {std::pair{std::string("t.npy"),
                  npy("'<f8'", fmt::format("({},)", log_samples), times.bytes)},
        std::pair{std::string("gyro.npy"),
                  npy("'<f8'", fmt::format("({}, 3)", log_samples), rates.bytes)}}) {
    const auto size = static_cast<std::uint32_t>(array.size());
    const auto at = static_cast<std::uint32_t>(archive.bytes.size());
    const auto name_size = static_cast<std::uint16_t>(name.size());
    archive.raw("PK\x03\x04")
        .number(std::uint16_t{20})
        .number(std::uint16_t{0})
        .number(std::uint16_t{0});
    archive.number(0u).number(0u).number(size).number(size).number(name_size).number(
        std::uint16_t{0});
    archive.raw(name).raw(array);
    directory.raw("PK\x01\x02")
        .number(std::uint16_t{20})
        .number(std::uint16_t{20})
        .number(std::uint16_t{0});
    directory.number(std::uint16_t{0})
        .number(0u)
        .number(0u)
        .number(size)
        .number(size)
        .number(name_size);
    directory.number(std::uint16_t{0})
        .number(std::uint16_t{0})
        .number(0u)
        .number(0u)
        .number(at)
        .raw(name);
    ++entries;
  }
  const auto begin = static_cast<std::uint32_t>(archive.bytes.size());
  archive.raw(directory.bytes).raw("PK\x05\x06").number(0u).number(entries).number(entries);
  archive.number(static_cast<std::uint32_t>(directory.bytes.size()))
      .number(begin)
      .number(std::uint16_t{0});
  return archive.bytes;
}

void write_rosbag2(const std::string& path) {
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  sqlite3_exec(database,
               "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
               "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
               "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp "
               "INTEGER NOT NULL, data BLOB NOT NULL);"
               "INSERT INTO topics VALUES(1,'/imu','sensor_msgs/msg/Imu','cdr','');"
               "INSERT INTO topics VALUES(2,'/chatter','std_msgs/msg/String','cdr','');"
               "INSERT INTO messages VALUES(1,2,5,x'00010000'); BEGIN",
               nullptr, nullptr, nullptr);
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id,timestamp,data) VALUES(1,?,?)", -1,
                     &insert, nullptr);
  for (int k = 0; k < log_samples; ++k) {
    const auto message = cdr(k);
    sqlite3_bind_int64(insert, 1, log_time_ns(k));
    sqlite3_bind_blob(insert, 2, message.data(), static_cast<int>(message.size()),
                      SQLITE_TRANSIENT);
    sqlite3_step(insert);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(database);
}

}  // namespace gyrostat
