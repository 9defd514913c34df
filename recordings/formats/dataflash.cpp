#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>

#include <gyrostat/recordings/binary/cursor.hpp>
#include <gyrostat/recordings/binary/imu_log.hpp>
#include <gyrostat/recordings/binary/whole_file.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::dataflash {
namespace {

constexpr std::string_view mark("\xa3\x95", 2);
constexpr std::uint8_t format_type = 128;
constexpr std::size_t format_bytes = 86;  // behind its mark and type

std::string_view without_zeros(std::string_view text) { return text.substr(0, text.find('\0')); }

/// Bytes of a field by its letter; 0 where the letter is unknown.
std::size_t size_of(char letter) {
  switch (letter) {
    case 'b':
    case 'B':
    case 'M':
      return 1;
    case 'h':
    case 'H':
    case 'c':
    case 'C':
    case 'g':
      return 2;
    case 'i':
    case 'I':
    case 'f':
    case 'n':
    case 'e':
    case 'E':
    case 'L':
      return 4;
    case 'd':
    case 'q':
    case 'Q':
      return 8;
    case 'N':
      return 16;
    case 'Z':
    case 'a':
      return 64;
    default:
      return 0;
  }
}

double number(char letter, Cursor at) {
  switch (letter) {
    case 'f':
      return static_cast<double>(at.number<float>());
    case 'd':
      return at.number<double>();
    case 'Q':
      return static_cast<double>(at.number<std::uint64_t>());
    case 'q':
      return static_cast<double>(at.number<std::int64_t>());
    case 'I':
      return at.number<std::uint32_t>();
    case 'i':
      return at.number<std::int32_t>();
    case 'H':
      return at.number<std::uint16_t>();
    case 'h':
      return at.number<std::int16_t>();
    case 'c':
      return at.number<std::int16_t>() / 100.0;
    case 'C':
      return at.number<std::uint16_t>() / 100.0;
    case 'e':
      return at.number<std::int32_t>() / 100.0;
    case 'E':
      return at.number<std::uint32_t>() / 100.0;
    case 'B':
      return at.number<std::uint8_t>();
    case 'b':
      return at.number<std::int8_t>();
    default:
      return no_value;
  }
}

/// A kind of message as the log itself describes it.
struct Kind {
  struct Column {
    std::size_t at;
    char letter;
  };
  std::string name;
  std::size_t bytes = 0;  ///< behind its mark and type
  std::map<std::string, Column, std::less<>> columns;

  bool has(std::string_view column) const { return columns.contains(column); }
  double value(std::string_view column, std::string_view message) const {
    const auto found = columns.find(column);
    if (found == columns.end()) return no_value;
    return number(found->second.letter, Cursor(message.substr(found->second.at)));
  }
};

Kind kind_of(std::string_view name, std::string_view letters, std::string_view labels,
             std::size_t bytes) {
  Kind kind{std::string(name), bytes, {}};
  std::size_t at = 0;
  for (const char letter : letters) {
    const auto end = std::min(labels.find(','), labels.size());
    if (size_of(letter) == 0 || at + size_of(letter) > bytes) break;
    kind.columns[std::string(labels.substr(0, end))] = {at, letter};
    at += size_of(letter);
    labels.remove_prefix(std::min(end + 1, labels.size()));
  }
  return kind;
}

/// IMU, IMU2 and IMU3, or from 2020 on IMU with the number of the sensor; GYR where raw samples are
/// logged.
void add_message(const Kind& kind, std::string_view message, ImuLog& log) {
  ImuSample sample;
  const double time_us = kind.value(kind.has("SampleUS") ? "SampleUS" : "TimeUS", message);
  if (!(time_us >= 0.0 && time_us < 9e15)) return;  // beyond what nanoseconds hold
  sample.t_ns = 1000 * static_cast<std::int64_t>(time_us);
  constexpr std::array<char, 3> axes = {'X', 'Y', 'Z'};
  for (std::size_t k = 0; k < axes.size(); ++k) {
    sample.gyro_rad_s[k] = kind.value(std::string("Gyr") + axes[k], message);
    sample.acc_mps2[k] = kind.value(std::string("Acc") + axes[k], message);
  }
  sample.temperature_C = kind.value(kind.has("T") ? "T" : "Temp", message);
  const double instance = kind.value("I", message);
  log.add(instance == instance ? fmt::format("{}[{:g}]", kind.name, instance) : kind.name, sample);
}

ColumnTable read(const FormatSource& source) {
  const WholeFile file(source);
  Cursor at(file.bytes());
  std::array<Kind, 256> kinds;
  ImuLog log;
  try {
    while (!at.empty()) {
      if (!at.rest().starts_with(mark)) {  // damaged: on to the next mark
        const auto next = at.rest().find(mark, 1);
        at.bytes(next == std::string_view::npos ? at.size() : next);
        continue;
      }
      at.bytes(mark.size());
      const auto type = at.number<std::uint8_t>();
      if (type == format_type) {
        Cursor body(at.bytes(format_bytes));
        const auto described = body.number<std::uint8_t>();
        const auto length = body.number<std::uint8_t>();
        const auto name = without_zeros(body.bytes(4));
        const auto letters = without_zeros(body.bytes(16));
        if (length >= 3)
          kinds[described] = kind_of(name, letters, without_zeros(body.bytes(64)), length - 3u);
        continue;
      }
      const auto& kind = kinds[type];
      if (kind.name.empty()) continue;  // not described: on to the next mark
      const auto message = at.bytes(kind.bytes);
      const bool is_gyro = (kind.has("TimeUS") || kind.has("SampleUS")) && kind.has("GyrX") &&
                           kind.has("GyrY") && kind.has("GyrZ");
      const bool is_whole = at.empty() || at.rest().starts_with(mark);
      if (is_gyro && is_whole) add_message(kind, message, log);
    }
  } catch (const CutOff&) {
    log.cut_off();
  }
  return std::move(log).table(source.topic, source.place, "IMU or GYR messages");
}

}  // namespace

/// A DataFlash log of ArduPilot (.bin), which begins by describing its own messages by FMT (ArduPilot,
/// LogStructure.h): TimeUS in µs, GyrX, GyrY, GyrZ in rad/s, AccX, … in m/s², T in °C.
RecordingFormat format() {
  return {
      .title = "ArduPilot DataFlash (.bin): IMU or GYR messages",
      .recognises = [](const FormatHead& head) { return head.starts_with("\xa3\x95\x80"); },
      .read = read};
}

}  // namespace gyrostat::formats::dataflash
