#include <gyrostat/recordings/matlab_integrity.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string>

#include <fmt/format.h>
#include <zlib.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t header_bytes = 128, tag_bytes = 8;
constexpr std::uint32_t compressed = 15;  // miCOMPRESSED

std::uint32_t number_at(const std::string& bytes, std::size_t at, bool swapped) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return swapped ? __builtin_bswap32(number) : number;
}

/// Whether `size` bytes are one zlib stream from its beginning to its checksum.
bool unpacks(const char* data, std::size_t size) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closed_on_return(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data));
  stream.avail_in = static_cast<uInt>(size);
  std::array<Bytef, 1 << 16> text{};
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = text.data();
    stream.avail_out = static_cast<uInt>(text.size());
    status = inflate(&stream, Z_NO_FLUSH);
  }
  return status == Z_STREAM_END;
}

}  // namespace

void require_whole_mat(const std::filesystem::path& path) {
  const auto place = path.string();
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const auto byte_order = bytes.size() < header_bytes ? std::string() : bytes.substr(126, 2);
  if (!bytes.starts_with("MATLAB") || (byte_order != "IM" && byte_order != "MI"))
    throw InputError(
        place, "is no MATLAB file of a version that can be read; allowed: 5 (-v6, -v7) and 7.3");
  if (bytes.starts_with("MATLAB 7.3")) return;
  const bool swapped = (byte_order == "MI") == (std::endian::native == std::endian::little);
  for (std::size_t at = header_bytes; at < bytes.size();) {
    const auto size =
        bytes.size() - at < tag_bytes ? bytes.size() : number_at(bytes, at + 4, swapped);
    const auto begin = at + tag_bytes;
    if (size > bytes.size() || begin + size > bytes.size())
      throw InputError(place,
                       fmt::format("the MATLAB file is truncated after {} bytes", bytes.size()));
    if (number_at(bytes, at, swapped) == compressed && !unpacks(bytes.data() + begin, size))
      throw InputError(
          place,
          fmt::format("the MATLAB file is corrupt: the variable at byte {} does not unpack", at));
    at = begin + size;
  }
}

}  // namespace gyrostat
