#include <gyrostat/recordings/input_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/unpacked_size.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t head_bytes = std::size_t{1} << 16;

}  // namespace

struct InputFile::Source {
  std::FILE* file = nullptr;
  bool packed = false, member_done = false;
  z_stream stream{};
  std::vector<char> waiting;
  std::uint64_t in = 0, out = 0;

  ~Source() {
    if (packed) inflateEnd(&stream);
    if (file && file != stdin) std::fclose(file);
  }
};

InputFile::InputFile(const fs::path& path)
    : path_(path),
      place_(path == "-" ? "standard input" : path.string()),
      source_(std::make_unique<Source>()) {
  std::error_code unknown;
  if (path != "-" && fs::is_directory(path, unknown))
    throw InputError(place_, "is a directory; allowed: a file");
  source_->file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
  if (!source_->file)
    throw InputError(place_, "cannot be read: " + std::generic_category().message(errno));
  if (const auto size = fs::file_size(path, unknown); !unknown) size_hint_ = size;
  source_->waiting.resize(head_bytes);
  std::string begin(2, '\0');
  begin.resize(read_raw(begin.data(), begin.size()));
  if (begin == "\x1f\x8b") {
    if (inflateInit2(&source_->stream, MAX_WBITS + 16) != Z_OK) throw std::bad_alloc();
    source_->packed = true;
    std::copy(begin.begin(), begin.end(), source_->waiting.begin());
    source_->stream.next_in = reinterpret_cast<Bytef*>(source_->waiting.data());
    source_->stream.avail_in = 2;
    source_->in = 2;
    size_hint_ *= 4;
    begin.clear();
  }
  head_.resize(head_bytes);
  std::copy(begin.begin(), begin.end(), head_.begin());
  std::size_t filled = begin.size();
  const auto next = [&](char* to, std::size_t most) {
    return source_->packed ? read_unpacked(to, most) : read_raw(to, most);
  };
  while (filled < head_.size()) {
    const auto got = next(head_.data() + filled, head_.size() - filled);
    if (got == 0) break;
    filled += got;
  }
  head_.resize(filled);
}

InputFile::~InputFile() = default;

std::size_t InputFile::read_raw(char* to, std::size_t most) {
  const auto got = std::fread(to, 1, most, source_->file);
  if (got < most && std::ferror(source_->file))
    throw InputError(place_, "cannot be read: " + std::generic_category().message(errno));
  return got;
}

std::size_t InputFile::read_unpacked(char* to, std::size_t most) {
  auto& [file, packed, member_done, stream, waiting, in, out] = *source_;
  stream.next_out = reinterpret_cast<Bytef*>(to);
  stream.avail_out = static_cast<uInt>(std::min<std::size_t>(most, 1u << 30));
  const auto room = stream.avail_out;
  while (stream.avail_out == room) {
    if (stream.avail_in == 0) {
      const auto got = read_raw(waiting.data(), waiting.size());
      stream.next_in = reinterpret_cast<Bytef*>(waiting.data());
      stream.avail_in = static_cast<uInt>(got);
      in += got;
      if (got == 0) {
        if (member_done) return 0;
        throw InputError(place_,
                         fmt::format("the gzip data are truncated after {} bytes of text", out));
      }
    }
    if (member_done) inflateReset(&stream);
    const int status = inflate(&stream, Z_NO_FLUSH);
    member_done = status == Z_STREAM_END;
    if (!member_done && status != Z_OK && status != Z_BUF_ERROR)
      throw InputError(place_, fmt::format("the gzip data are corrupt after {} bytes of text: {}",
                                           out, stream.msg ? stream.msg : zError(status)));
  }
  const std::size_t made = room - stream.avail_out;
  out += made;
  require_plausible_size(place_, in, out, "numbers");
  return made;
}

std::size_t InputFile::read(char* to, std::size_t most) {
  if (head_read_ < head_.size()) {
    const auto count = std::min(most, head_.size() - head_read_);
    std::memcpy(to, head_.data() + head_read_, count);
    head_read_ += count;
    return count;
  }
  return source_->packed ? read_unpacked(to, most) : read_raw(to, most);
}

bool InputFile::is_plain() const {
  std::error_code unknown;
  return !source_->packed && path_ != "-" && fs::is_regular_file(path_, unknown);
}

std::string InputFile::rest(std::size_t most) {
  const auto expected = static_cast<std::size_t>(std::min<std::uintmax_t>(size_hint_, most));
  std::string bytes(std::max(expected + 1, 2 * head_bytes), '\0');
  std::size_t filled = 0;
  while (const auto got = read(bytes.data() + filled, bytes.size() - filled)) {
    filled += got;
    if (filled > most)
      throw InputError(place_, fmt::format("is too long; allowed: up to {} MiB", most >> 20));
    if (filled == bytes.size()) bytes.resize(std::min(2 * filled, most + 1));
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace gyrostat
