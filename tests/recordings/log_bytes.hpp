#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gyrostat {

/// Bytes of a log, little-endian, put together by a test.
struct LogBytes {
  std::string bytes;

  template <class T>
  LogBytes& number(T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  LogBytes& raw(std::string_view text) {
    bytes += text;
    return *this;
  }
  /// Behind its length of four bytes.
  LogBytes& text(std::string_view text) {
    return number(static_cast<std::uint32_t>(text.size())).raw(text);
  }
  LogBytes& padded(std::string_view text, std::size_t size) {
    bytes += text;
    bytes.append(size - text.size(), '\0');
    return *this;
  }
  LogBytes& align(std::size_t size, std::size_t head) {
    while ((bytes.size() - head) % size != 0) bytes += '\0';
    return *this;
  }
};

// Sample k of every log: at 100 Hz from 2023-11-14, the rates k, 2 k and 3 k mrad/s, and 9.81 m/s².
inline constexpr int log_samples = 50;
inline constexpr std::int64_t log_start_ns = 1'700'000'000'123'000'000;
inline std::int64_t log_time_ns(int k) { return log_start_ns + 10'000'000LL * k; }
inline double log_rate(int k, int axis) { return 1e-3 * k * (axis + 1); }

std::string ulog_bytes();
std::string fifo_ulog_bytes();
std::string dataflash_bytes();
std::string mcap_bytes(const std::string& compression);
std::string bag_bytes(const std::string& compression);
std::string npy_bytes();
std::string npz_bytes();
std::string record_npy_bytes();
void write_rosbag2(const std::string& path);

}  // namespace gyrostat
