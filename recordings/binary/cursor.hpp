#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace gyrostat {

/// There are fewer bytes than a record says.
struct CutOff : std::runtime_error {
  CutOff() : std::runtime_error("is cut off") {}
};

/// Reads little-endian numbers off the front of some bytes; every member throws CutOff beyond their
/// end, whatever a count in the file says.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }
  std::size_t size() const { return rest_.size(); }
  std::string_view rest() const { return rest_; }

  std::string_view bytes(std::uint64_t count) {
    if (count > rest_.size()) throw CutOff();
    const auto piece = rest_.substr(0, static_cast<std::size_t>(count));
    rest_.remove_prefix(piece.size());
    return piece;
  }
  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T> && std::endian::native == std::endian::little);
    T value;
    std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    return value;
  }
  /// A text behind its length of four bytes.
  std::string_view text() { return bytes(number<std::uint32_t>()); }

 private:
  std::string_view rest_;
};

}  // namespace gyrostat
