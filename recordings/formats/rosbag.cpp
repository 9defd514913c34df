#include <map>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/binary/message_log.hpp>
#include <gyrostat/recordings/binary/sensor_msgs.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::rosbag {
namespace {

constexpr std::string_view magic = "#ROSBAG V2.0\n";
enum Operation : std::uint8_t { message_data = 2, chunk = 5, connection = 7 };

/// "name=value" fields, each behind its length.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  std::string_view text(std::string_view name) const {
    for (Cursor at(bytes_); !at.empty();) {
      const auto field = at.text();
      if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=')
        return field.substr(name.size() + 1);
    }
    return {};
  }
  template <class T>
  T number(std::string_view name) const {
    return Cursor(text(name)).number<T>();
  }

 private:
  std::string_view bytes_;
};

struct Reader {
  Unpacker unpacker;
  ImuLog log{};
  std::map<std::uint32_t, std::string> imu_topics{};

  void read(Cursor at, bool in_chunk) {
    while (!at.empty()) {
      const Fields header(at.text());
      const auto data = at.text();
      const auto operation = header.number<std::uint8_t>("op");
      if (operation == connection) {
        const auto id = header.number<std::uint32_t>("conn");
        imu_topics.erase(id);
        if (is_imu_type(Fields(data).text("type")))
          imu_topics[id] = std::string(header.text("topic"));
      } else if (operation == message_data) {
        const auto found = imu_topics.find(header.number<std::uint32_t>("conn"));
        if (found == imu_topics.end()) continue;
        Cursor time(header.text("time"));
        const std::int64_t s = time.number<std::uint32_t>(), ns = time.number<std::uint32_t>();
        log.add(found->second, imu_of_ros1(data, s * 1'000'000'000 + ns));
      } else if (operation == chunk && !in_chunk) {
        read(Cursor(unpacker.unpack(data, header.text("compression"),
                                    header.number<std::uint32_t>("size"))),
             true);
      }
    }
  }
};

}  // namespace

/// A ROS 1 bag of version 2.0, whole or cut off, in chunks that are plain, bzip2 or LZ4: its
/// messages of sensor_msgs/Imu (ROS wiki, Bags/Format/2.0). The index is not needed.
RecordingFormat format() {
  return {
      .title = "ROS 1 bag: sensor_msgs/Imu",
      .recognises = [](const FormatHead& head) { return head.starts_with(magic); },
      .read = [](const FormatSource& source) { return read_message_log<Reader>(source, magic); }};
}

}  // namespace gyrostat::formats::rosbag
