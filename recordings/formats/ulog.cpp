#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/binary/cursor.hpp>
#include <gyrostat/recordings/binary/imu_log.hpp>
#include <gyrostat/recordings/binary/whole_file.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::ulog {
namespace {

constexpr std::string_view magic("ULog\x01\x12\x35", 7);
constexpr std::size_t header_bytes = 16, largest_message = 65535;
constexpr int deepest = 8;

struct Field {
  std::string type, name;
  std::size_t count = 1;
};
using Definitions = std::map<std::string, std::vector<Field>, std::less<>>;

/// "uint64_t timestamp;float[3] gyro_rad;…" behind the name of its message and a colon.
void define(std::string_view text, Definitions& definitions) {
  const auto colon = text.find(':');
  if (colon == text.npos) return;
  auto& fields = definitions[std::string(text.substr(0, colon))];
  fields.clear();
  for (auto rest = text.substr(colon + 1); !rest.empty();) {
    const auto end = std::min(rest.find(';'), rest.size());
    const auto piece = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const auto blank = piece.find(' ');
    if (blank == piece.npos) continue;
    Field field{std::string(piece.substr(0, blank)), std::string(piece.substr(blank + 1))};
    if (const auto open = field.type.find('['); open != field.type.npos) {
      const char* begin = field.type.data() + open + 1;
      std::from_chars(begin, field.type.data() + field.type.size(), field.count);
      field.count = std::min(field.count, largest_message + 1);
      field.type.resize(open);
    }
    fields.push_back(std::move(field));
  }
}

/// Bytes of a type of the specification; 0 for one that a message defines.
std::size_t basic_size(std::string_view type) {
  struct Known {
    std::string_view name;
    std::size_t size;
  };
  for (const auto& [name, size] :
       {Known{"int8_t", 1}, Known{"uint8_t", 1}, Known{"bool", 1}, Known{"char", 1},
        Known{"int16_t", 2}, Known{"uint16_t", 2}, Known{"int32_t", 4}, Known{"uint32_t", 4},
        Known{"float", 4}, Known{"int64_t", 8}, Known{"uint64_t", 8}, Known{"double", 8}})
    if (type == name) return size;
  return 0;
}

/// Bytes of a type; nothing where it is unknown or larger than a message.
std::optional<std::size_t> size_of(const std::string& type, const Definitions& definitions,
                                   int depth = 0) {
  if (const auto size = basic_size(type)) return size;
  const auto found = definitions.find(type);
  if (found == definitions.end() || depth > deepest || found->second.size() > 4096)
    return std::nullopt;
  std::size_t sum = 0;
  for (const auto& field : found->second) {
    const auto size = size_of(field.type, definitions, depth + 1);
    if (!size || *size * field.count > largest_message) return std::nullopt;
    sum += *size * field.count;
    if (sum > largest_message) return std::nullopt;
  }
  return sum;
}

double number(std::string_view type, std::string_view bytes) {
  Cursor at(bytes);
  if (type == "float") return static_cast<double>(at.number<float>());
  if (type == "double") return at.number<double>();
  if (type == "uint64_t") return static_cast<double>(at.number<std::uint64_t>());
  if (type == "uint32_t") return static_cast<double>(at.number<std::uint32_t>());
  if (type == "int32_t") return static_cast<double>(at.number<std::int32_t>());
  if (type == "int16_t") return static_cast<double>(at.number<std::int16_t>());
  if (type == "uint8_t") return static_cast<double>(at.number<std::uint8_t>());
  return no_value;
}

/// Where the numbers of a subscribed topic stand in its messages.
struct Place {
  std::size_t at;
  Field field;
};
struct Subscription {
  std::string topic;
  std::map<std::string, Place, std::less<>> fields;

  bool has(std::string_view name, std::size_t count) const {
    const auto found = fields.find(name);
    return found != fields.end() && found->second.field.count >= count;
  }
  double value(std::string_view name, std::size_t index, std::string_view message) const {
    const auto found = fields.find(name);
    if (found == fields.end()) return no_value;
    const auto& [at, field] = found->second;
    const auto size = basic_size(field.type);
    if (size == 0 || index >= field.count || at + (index + 1) * size > message.size())
      throw CutOff();
    return number(field.type, message.substr(at + index * size, size));
  }
  std::int64_t micros(std::string_view name, std::string_view message) const {
    const auto& [at, field] = fields.find(name)->second;
    if (field.type != "uint64_t" || at + 8 > message.size()) throw CutOff();
    return static_cast<std::int64_t>(Cursor(message.substr(at)).number<std::uint64_t>() %
                                     (std::uint64_t{1} << 52));
  }
};

Subscription subscribe(const std::string& name, int instance, const Definitions& definitions) {
  Subscription subscription{instance == 0 ? name : fmt::format("{}:{}", name, instance), {}};
  const auto fields = definitions.find(name);
  if (fields == definitions.end()) return subscription;
  std::size_t at = 0;
  for (const auto& field : fields->second) {
    subscription.fields.emplace(field.name, Place{at, field});
    const auto size = size_of(field.type, definitions);
    if (!size) break;  // what stands behind it cannot be found
    at += *size * field.count;
  }
  return subscription;
}

/// Of sensor_combined, and of sensor_gyro with x, y, z.
void add_single(const Subscription& topic, std::string_view message, ImuLog& log) {
  ImuSample sample;
  const bool combined = topic.has("gyro_rad", 3);
  constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
  sample.t_ns =
      1000 *
      topic.micros(!combined && topic.has("timestamp_sample", 1) ? "timestamp_sample" : "timestamp",
                   message);
  for (std::size_t k = 0; k < 3; ++k) {
    sample.gyro_rad_s[k] =
        combined ? topic.value("gyro_rad", k, message) : topic.value(axes[k], 0, message);
    if (combined && topic.has("accelerometer_m_s2", 3))
      sample.acc_mps2[k] = topic.value("accelerometer_m_s2", k, message);
  }
  if (!combined) sample.temperature_C = topic.value("temperature", 0, message);
  log.add(topic.topic, sample);
}

/// Of sensor_gyro_fifo: `samples` counts about each axis, `dt` µs apart, the last at
/// timestamp_sample.
void add_fifo(const Subscription& topic, std::string_view message, ImuLog& log) {
  const auto most = topic.fields.find("x")->second.field.count;
  const auto count = static_cast<std::size_t>(
      std::clamp(topic.value("samples", 0, message), 0.0, static_cast<double>(most)));
  const double scale = topic.value("scale", 0, message), dt_us = topic.value("dt", 0, message);
  const auto last_us = topic.micros("timestamp_sample", message);
  for (std::size_t i = 0; i < count; ++i) {
    ImuSample sample;
    const double before_us = dt_us * static_cast<double>(count - 1 - i);
    if (!(before_us >= 0.0 && before_us < 1e9)) throw CutOff();
    sample.t_ns = 1000 * last_us - static_cast<std::int64_t>(1000.0 * before_us);
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k)
      sample.gyro_rad_s[k] = scale * topic.value(axes[k], i, message);
    log.add(topic.topic, sample);
  }
}

using AddMessage = void (*)(const Subscription&, std::string_view, ImuLog&);

/// How samples are taken from messages of a topic; nothing where it is no gyro's.
AddMessage taker(const std::string& name, const Subscription& topic) {
  if (!topic.has("timestamp", 1)) return nullptr;
  const bool xyz = topic.has("x", 1) && topic.has("y", 1) && topic.has("z", 1);
  if (name == "sensor_combined" && topic.has("gyro_rad", 3)) return add_single;
  if (name == "sensor_gyro" && xyz) return add_single;
  if (name == "sensor_gyro_fifo" && xyz && topic.has("samples", 1) && topic.has("scale", 1) &&
      topic.has("dt", 1) && topic.has("timestamp_sample", 1))
    return add_fifo;
  return nullptr;
}

ColumnTable read(const FormatSource& source) {
  const WholeFile file(source);
  Cursor at(file.bytes());
  Definitions definitions;
  struct Taken {
    Subscription topic;
    AddMessage add;
  };
  std::map<std::uint16_t, Taken> taken;
  ImuLog log;
  try {
    at.bytes(header_bytes);
    while (!at.empty()) {
      const auto size = at.number<std::uint16_t>();
      const auto type = at.number<char>();
      Cursor body(at.bytes(size));
      if (type == 'F') define(body.rest(), definitions);
      if (type == 'A') {
        const int instance = body.number<std::uint8_t>();
        const auto id = body.number<std::uint16_t>();
        const std::string name(body.rest());
        auto topic = subscribe(name, instance, definitions);
        const auto add = taker(name, topic);
        taken.erase(id);
        if (add) taken.emplace(id, Taken{std::move(topic), add});
      }
      if (type == 'D') {
        const auto found = taken.find(body.number<std::uint16_t>());
        if (found != taken.end()) found->second.add(found->second.topic, body.rest(), log);
      }
    }
  } catch (const CutOff&) {
    log.cut_off();
  }
  return std::move(log).table(source.topic, source.place,
                              "a topic sensor_combined, sensor_gyro or sensor_gyro_fifo");
}

}  // namespace

/// A flight log of PX4, version 1 of ULog (docs.px4.io, "ULog File Format"): sensor_combined,
/// sensor_gyro and sensor_gyro_fifo. Appended data behind a crash dump are read as far as they are
/// whole.
RecordingFormat format() {
  return {.title = "PX4 ULog: sensor_combined, sensor_gyro or sensor_gyro_fifo",
          .recognises = [](const FormatHead& head) { return head.starts_with(magic); },
          .read = read};
}

}  // namespace gyrostat::formats::ulog
