#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gyrostat {

/// Unpacks the chunks of one log. All of them together may be a hundred times the packed bytes and
/// no single one more than 256 MiB: what says otherwise is an InputError before memory is taken.
class Unpacker {
 public:
  explicit Unpacker(std::string place) : place_(std::move(place)) {}

  /// `packed` as "" or "none" (as it is), "lz4" (frames), "zstd", "bz2" or "deflate" (raw) has it,
  /// of `size` bytes once unpacked. The text lives until the next call.
  std::string_view unpack(std::string_view packed, std::string_view method, std::uint64_t size);

 private:
  std::string place_, text_;
  std::uint64_t in_ = 0, out_ = 0;
};

}  // namespace gyrostat
