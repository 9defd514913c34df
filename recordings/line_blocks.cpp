#include <gyrostat/recordings/line_blocks.hpp>

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/input_file.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 22, small_block = std::size_t{1} << 16,
                      longest_line = std::size_t{1} << 24;

/// A small file needs no block of four megabytes, which takes longer to clear than the file to
/// read. How large one is that comes by a pipe is not known.
std::size_t first_block(const InputFile& file) {
  return file.size_hint() > 0 && 2 * file.size_hint() < small_block ? small_block : block_bytes;
}

}  // namespace

LineBlocks::LineBlocks(InputFile& file) : file_(file), block_(first_block(file), '\0') {
  const auto head = file.head();
  const auto zeros = [&](std::size_t from) {
    std::size_t count = 0;
    for (std::size_t i = from; i < std::min<std::size_t>(head.size(), 64); i += 2)
      count += head[i] == '\0' ? 1 : 0;
    return count;
  };
  const std::size_t most = std::min<std::size_t>(head.size(), 64) / 2;
  if (head.starts_with("\xff\xfe") || (most >= 8 && zeros(1) == most && zeros(0) == 0))
    encoding_ = Encoding::utf16_little;
  else if (head.starts_with("\xfe\xff") || (most >= 8 && zeros(0) == most && zeros(1) == 0))
    encoding_ = Encoding::utf16_big;
}

std::size_t LineBlocks::fill(char* to, std::size_t most) {
  if (encoding_ == Encoding::bytes) {
    const auto got = file_.read(to, most);
    if (const void* zero = std::memchr(to, 0, got))
      throw InputError(
          file_.place(),
          fmt::format("is not text: byte {} is zero",
                      before_ + static_cast<std::size_t>(static_cast<const char*>(zero) - to)));
    before_ += got;
    return got;
  }
  // Two bytes become at most three.
  const auto kept = raw_.size();
  raw_.resize(kept + std::max<std::size_t>(2, most / 3));
  raw_.resize(kept + file_.read(raw_.data() + kept, raw_.size() - kept));
  char* end = to;
  std::size_t i = 0;
  for (; i + 1 < raw_.size(); i += 2) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(raw_[i + k]); };
    unsigned unit =
        encoding_ == Encoding::utf16_little ? byte(0) + 256u * byte(1) : byte(1) + 256u * byte(0);
    if (unit >= 0xD800 && unit < 0xDC00) {
      high_surrogate_ = unit;
      continue;
    }
    if (unit >= 0xDC00 && unit < 0xE000)
      unit = 0x10000 + ((high_surrogate_ & 0x3FF) << 10) + (unit & 0x3FF);
    if (unit == 0) throw InputError(file_.place(), "is not text: it holds a zero character");
    if (unit == 0xFEFF) continue;  // the byte order mark
    const auto put = [&](unsigned value) { *end++ = static_cast<char>(value); };
    if (unit < 0x80) {
      put(unit);
    } else if (unit < 0x800) {
      put(0xC0 | unit >> 6);
      put(0x80 | (unit & 0x3F));
    } else if (unit < 0x10000) {
      put(0xE0 | unit >> 12);
      put(0x80 | (unit >> 6 & 0x3F));
      put(0x80 | (unit & 0x3F));
    } else {
      put(0xF0 | unit >> 18);
      put(0x80 | (unit >> 12 & 0x3F));
      put(0x80 | (unit >> 6 & 0x3F));
      put(0x80 | (unit & 0x3F));
    }
  }
  const bool ended = raw_.size() == kept;
  raw_.erase(0, i);
  if (end == to && !ended) return fill(to, most);
  return static_cast<std::size_t>(end - to);
}

std::string_view LineBlocks::next() {
  constexpr std::size_t least_room = 64;
  std::memmove(block_.data(), block_.data() + used_, filled_ - used_);
  filled_ -= used_;
  while (true) {
    if (filled_ > longest_line)
      throw InputError(file_.place(), "has a line of more than 16 MiB; allowed: a row a line");
    if (block_.size() - filled_ < least_room) block_.resize(2 * block_.size());
    std::size_t got = 1;
    while (got > 0 && block_.size() - filled_ >= least_room) {
      got = fill(block_.data() + filled_, block_.size() - filled_);
      filled_ += got;
    }
    const auto end = std::string_view(block_.data(), filled_).rfind('\n');
    used_ = got == 0 ? filled_ : end == std::string_view::npos ? 0 : end + 1;
    if (got == 0 || used_ > 0) return {block_.data(), used_};
  }
}

}  // namespace gyrostat
