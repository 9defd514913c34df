#include <map>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/binary/message_log.hpp>
#include <gyrostat/recordings/binary/sensor_msgs.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::mcap {
namespace {

constexpr std::string_view magic("\x89MCAP0\r\n", 8);
enum Opcode : std::uint8_t { schema = 3, channel = 4, message = 5, chunk = 6, data_end = 15 };

struct Reader {
  struct Channel {
    std::string topic;
    ImuSample (*decode)(std::string_view, std::int64_t);
  };
  Unpacker unpacker;
  ImuLog log{};
  std::map<std::uint16_t, bool> imu_schemas{};
  std::map<std::uint16_t, Channel> channels{};

  /// Records up to the end of the data; those of a chunk hold no chunks.
  void read(Cursor at, bool in_chunk) {
    while (!at.empty()) {
      const auto opcode = at.number<std::uint8_t>();
      const auto length = at.number<std::uint64_t>();
      Cursor body(at.bytes(length));
      if (opcode == data_end) return;
      if (opcode == schema) {
        const auto id = body.number<std::uint16_t>();
        imu_schemas[id] = is_imu_type(body.text());
      } else if (opcode == channel) {
        add_channel(body);
      } else if (opcode == message) {
        add_message(body);
      } else if (opcode == chunk && !in_chunk) {
        body.bytes(16);  // first and last time
        const auto size = body.number<std::uint64_t>();
        body.bytes(4);  // checksum
        const auto method = body.text();
        const auto packed = body.bytes(body.number<std::uint64_t>());
        read(Cursor(unpacker.unpack(packed, method, size)), true);
      }
    }
  }

  void add_channel(Cursor body) {
    const auto id = body.number<std::uint16_t>(), schema_id = body.number<std::uint16_t>();
    const auto topic = body.text(), encoding = body.text();
    channels.erase(id);
    const auto found = imu_schemas.find(schema_id);
    if (found == imu_schemas.end() || !found->second) return;
    if (encoding == "cdr") channels[id] = {std::string(topic), imu_of_cdr};
    if (encoding == "ros1") channels[id] = {std::string(topic), imu_of_ros1};
  }

  void add_message(Cursor body) {
    const auto found = channels.find(body.number<std::uint16_t>());
    if (found == channels.end()) return;
    body.bytes(4);  // sequence
    const auto logged = static_cast<std::int64_t>(body.number<std::uint64_t>());
    body.bytes(8);  // time of publishing
    log.add(found->second.topic, found->second.decode(body.rest(), logged));
  }
};

}  // namespace

/// MCAP, as rosbag2 and Foxglove write it: sensor_msgs/Imu in CDR or as ROS 1 has it, in chunks
/// that are plain, LZ4 or Zstandard (mcap.dev/spec, version 0).
RecordingFormat format() {
  return {
      .title = "MCAP (ROS 2, Foxglove): sensor_msgs/Imu",
      .recognises = [](const FormatHead& head) { return head.starts_with(magic); },
      .read = [](const FormatSource& source) { return read_message_log<Reader>(source, magic); }};
}

}  // namespace gyrostat::formats::mcap
