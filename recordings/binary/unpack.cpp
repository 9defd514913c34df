#include <gyrostat/recordings/binary/unpack.hpp>

#include <memory>

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/text.hpp>
#include <gyrostat/recordings/unpacked_size.hpp>

namespace gyrostat {
namespace {

constexpr std::uint64_t largest_chunk = std::uint64_t{1} << 28;

/// Bytes that came out; more than `text` holds, or damage, are no success.
bool unpack_lz4(std::string_view packed, std::string& text) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) return false;
  const std::unique_ptr<LZ4F_dctx, std::size_t (*)(LZ4F_dctx*)> freed(
      context, LZ4F_freeDecompressionContext);
  std::size_t in = 0, out = 0;
  while (in < packed.size()) {
    std::size_t room = text.size() - out, taken = packed.size() - in;
    const auto hint =
        LZ4F_decompress(context, text.data() + out, &room, packed.data() + in, &taken, nullptr);
    if (LZ4F_isError(hint) || (room == 0 && taken == 0)) return false;
    in += taken;
    out += room;
  }
  return out == text.size();
}

bool unpack_zstd(std::string_view packed, std::string& text) {
  const auto made = ZSTD_decompress(text.data(), text.size(), packed.data(), packed.size());
  return !ZSTD_isError(made) && made == text.size();
}

bool unpack_bz2(std::string_view packed, std::string& text) {
  auto made = static_cast<unsigned>(text.size());
  const int status =
      BZ2_bzBuffToBuffDecompress(text.data(), &made, const_cast<char*>(packed.data()),
                                 static_cast<unsigned>(packed.size()), 0, 0);
  return status == BZ_OK && made == text.size();
}

bool unpack_deflate(std::string_view packed, std::string& text) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return false;
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closed(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  return inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_out == 0;
}

}  // namespace

std::string_view Unpacker::unpack(std::string_view packed, std::string_view method,
                                  std::uint64_t size) {
  if (method.empty() || method == "none") return packed;
  in_ += packed.size();
  out_ += size;
  if (size > largest_chunk || packed.size() > largest_chunk)
    throw InputError(place_, fmt::format("has a chunk of {} MiB; allowed: up to 256 MiB",
                                         std::max<std::uint64_t>(size, packed.size()) >> 20));
  require_plausible_size(place_, in_, out_, "a log");
  if (size == 0) return {};
  text_.resize(static_cast<std::size_t>(size));
  const bool done = method == "lz4"    ? unpack_lz4(packed, text_)
                    : method == "zstd" ? unpack_zstd(packed, text_)
                    : method == "bz2"  ? unpack_bz2(packed, text_)
                    : method == "deflate"
                        ? unpack_deflate(packed, text_)
                        : throw InputError(place_, fmt::format("is packed by '{}'; allowed: "
                                                               "none, bz2, lz4, zstd",
                                                               printable(method.substr(0, 20))));
  if (!done) throw InputError(place_, fmt::format("has a chunk whose {} data are damaged", method));
  return text_;
}

}  // namespace gyrostat
