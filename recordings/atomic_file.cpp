#include <gyrostat/recordings/atomic_file.hpp>

#include <array>
#include <cerrno>
#include <new>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

namespace gyrostat {

namespace fs = std::filesystem;

namespace {

/// The temporary beside `target`, to be written by this object alone; null where the system
/// refuses. It has one name, so that a killed program leaves one and the next one takes it over;
/// only where another program is writing it at this moment, it has a name of its own.
std::FILE* open_temporary(const fs::path& target, TemporaryPath& temporary) {
  const auto usual = target.string() + ".tmp";
  const int file = ::open(usual.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  struct stat opened {
  }, named{};
  if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstat(file, &opened) == 0 &&
      ::stat(usual.c_str(), &named) == 0 && opened.st_ino == named.st_ino) {
    temporary = TemporaryPath(usual);
    return ::ftruncate(file, 0) == 0 ? ::fdopen(file, "wb") : nullptr;
  }
  if (file < 0) return nullptr;
  ::close(file);
  const auto own = target.string() + fmt::format(".{:08x}.tmp", std::random_device{}());
  auto* const stream = std::fopen(own.c_str(), "wbx");
  if (stream != nullptr) temporary = TemporaryPath(own);
  return stream;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code unknown;
  const auto status = fs::status(path, unknown);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_ = std::fopen(path.c_str(), "wb");
  } else {
    const auto resolved = fs::weakly_canonical(path, unknown);
    target_ = unknown ? path : resolved;
    file_ = open_temporary(target_, temporary_);
  }
  require(file_ != nullptr);
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
}

void AtomicFile::write(std::string_view piece) {
  require(std::fwrite(piece.data(), 1, piece.size(), file_) == piece.size());
}

void AtomicFile::commit() {
  require(std::fflush(file_) == 0 && (temporary_.empty() || fsync(fileno(file_)) == 0));
  // Renamed while it is still open, and so still locked.
  require(temporary_.empty() || std::rename(temporary_.path().c_str(), target_.c_str()) == 0);
  temporary_.keep();
  require(std::fclose(std::exchange(file_, nullptr)) == 0);
}

void AtomicFile::require(bool done) const {
  if (!done)
    throw std::runtime_error(path_.string() +
                             ": cannot be written: " + std::generic_category().message(errno));
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
