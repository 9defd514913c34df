#include <memory>

#include <fmt/format.h>
#include <sqlite3.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/binary/cursor.hpp>
#include <gyrostat/recordings/binary/imu_log.hpp>
#include <gyrostat/recordings/binary/sensor_msgs.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat::formats::rosbag2 {
namespace {

using namespace std::string_view_literals;

ColumnTable read(const FormatSource& source) {
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(source.path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
  const auto fail = [&] {
    throw InputError(source.place, fmt::format("cannot be read as rosbag2: {}",
                                               printable(sqlite3_errmsg(database.get()))));
  };
  if (status != SQLITE_OK) fail();
  sqlite3_limit(database.get(), SQLITE_LIMIT_LENGTH, 1 << 28);
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(database.get(),
                         "SELECT topics.name, messages.timestamp, messages.data, topics.type "
                         "FROM messages JOIN topics ON topics.id = messages.topic_id "
                         "WHERE topics.serialization_format = 'cdr' AND topics.type IN "
                         "('sensor_msgs/msg/Imu', 'sensor_msgs/Imu') ORDER BY messages.id",
                         -1, &prepared, nullptr) != SQLITE_OK)
    fail();
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> rows(prepared, sqlite3_finalize);
  ImuLog log;
  std::size_t damaged = 0;
  int step = SQLITE_OK;
  while ((step = sqlite3_step(rows.get())) == SQLITE_ROW) {
    const auto* topic = reinterpret_cast<const char*>(sqlite3_column_text(rows.get(), 0));
    const auto* data = static_cast<const char*>(sqlite3_column_blob(rows.get(), 2));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(rows.get(), 2));
    try {
      if (!topic || !data) throw CutOff();
      log.add(topic, imu_of_cdr({data, size}, sqlite3_column_int64(rows.get(), 1)));
    } catch (const CutOff&) {
      ++damaged;
    }
  }
  if (step != SQLITE_DONE) fail();
  auto table = std::move(log).table(source.topic, source.place, "a topic of sensor_msgs/msg/Imu");
  if (damaged > 0) table.notes.push_back(fmt::format("{} damaged messages left out", damaged));
  return table;
}

/// The names of rosbag2's tables stand in the schema, at the front of the file.
bool recognises(const FormatHead& head) {
  return head.starts_with("SQLite format 3\0"sv) && head.bytes.find("topics") != head.bytes.npos &&
         head.bytes.find("serialization_format") != head.bytes.npos;
}

}  // namespace

/// A .db3 of rosbag2 (its storage plug-in sqlite3): topics, and messages in CDR. Messages that are
/// packed one by one are not read; `ros2 bag convert` writes them plain.
RecordingFormat format() {
  return {.title = "rosbag2 (.db3): sensor_msgs/msg/Imu", .recognises = recognises, .read = read};
}

}  // namespace gyrostat::formats::rosbag2
