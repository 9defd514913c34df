#include <gyrostat/recordings/atomic_file.hpp>

#include <array>
#include <cerrno>
#include <new>
#include <random>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {

namespace fs = std::filesystem;

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code unknown;
  const auto status = fs::status(path, unknown);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_ = std::fopen(path.c_str(), "wb");
  } else {
    const auto resolved = fs::weakly_canonical(path, unknown);
    target_ = unknown ? path : resolved;
    temporary_ = target_.string() + fmt::format(".{:08x}.tmp", std::random_device{}());
    file_ = std::fopen(temporary_.c_str(), "wbx");
  }
  require(file_ != nullptr);
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  std::error_code absent;
  if (!temporary_.empty()) fs::remove(temporary_, absent);
}

void AtomicFile::write(std::string_view piece) {
  require(std::fwrite(piece.data(), 1, piece.size(), file_) == piece.size());
}

void AtomicFile::commit() {
  require(std::fflush(file_) == 0 && (temporary_.empty() || fsync(fileno(file_)) == 0));
  require(std::fclose(std::exchange(file_, nullptr)) == 0);
  require(temporary_.empty() || std::rename(temporary_.c_str(), target_.c_str()) == 0);
}

void AtomicFile::require(bool done) const {
  if (!done)
    throw InputError(path_.string(),
                     "cannot be written: " + std::generic_category().message(errno));
}

void write_atomically(const fs::path& path, std::string_view contents) {
  AtomicFile file(path);
  file.write(contents);
  file.commit();
}

struct Gzip::Stream : z_stream {};

constexpr std::size_t block_size = 1 << 16;

Gzip::Gzip(Sink sink) : sink_(std::move(sink)), stream_(std::make_unique<Stream>()) {
  // Digits pack within 13 % as well as at the default level, five times faster.
  if (deflateInit2(stream_.get(), Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + 16, MAX_MEM_LEVEL,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

Gzip::~Gzip() { deflateEnd(stream_.get()); }

void Gzip::write(std::string_view piece) {
  while (!piece.empty()) {
    const auto taken = std::min(piece.size(), block_size - waiting_.size());
    waiting_ += piece.substr(0, taken);
    piece.remove_prefix(taken);
    if (waiting_.size() == block_size) pack(Z_NO_FLUSH);
  }
}

void Gzip::finish() { pack(Z_FINISH); }

void Gzip::pack(int flush) {
  std::array<char, block_size> packed;
  stream_->next_in = reinterpret_cast<Bytef*>(waiting_.data());
  stream_->avail_in = static_cast<uInt>(waiting_.size());
  do {
    stream_->next_out = reinterpret_cast<Bytef*>(packed.data());
    stream_->avail_out = static_cast<uInt>(packed.size());
    deflate(stream_.get(), flush);
    sink_({packed.data(), packed.size() - stream_->avail_out});
  } while (stream_->avail_out == 0);
  waiting_.clear();
}

std::string gzipped(std::string_view contents) {
  std::string packed;
  Gzip gzip([&](std::string_view piece) { packed += piece; });
  gzip.write(contents);
  gzip.finish();
  return packed;
}

}  // namespace gyrostat
