#include "experiments/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <random>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include "core/error.hpp"

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

struct RemovedOnReturn {
  fs::path path;
  ~RemovedOnReturn() {
    std::error_code absent;
    fs::remove(path, absent);
  }
};

bool write_file(const fs::path& path, const char* mode, std::string_view contents, bool to_disk) {
  std::FILE* file = std::fopen(path.c_str(), mode);
  if (!file) return false;
  const bool written = std::fwrite(contents.data(), 1, contents.size(), file) == contents.size() &&
                       std::fflush(file) == 0 && (!to_disk || fsync(fileno(file)) == 0);
  const int reason = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = reason;
  return written && closed;
}

}  // namespace

void write_atomically(const fs::path& path, std::string_view contents) {
  const auto require = [&](bool done) {
    if (done) return;
    throw InputError(path.string(), "cannot be written: " + std::generic_category().message(errno));
  };
  std::error_code unknown;
  const auto status = fs::status(path, unknown);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return require(write_file(path, "wb", contents, false));
  }
  const auto resolved = fs::weakly_canonical(path, unknown);
  const fs::path target = unknown ? path : resolved;
  const RemovedOnReturn temporary{target.string() +
                                  fmt::format(".{:08x}.tmp", std::random_device{}())};
  require(write_file(temporary.path, "wbx", contents, true));
  require(std::rename(temporary.path.c_str(), target.c_str()) == 0);
}

std::string gzipped(std::string_view contents) {
  // Digits pack within 13 % as well as at the default level, five times faster.
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + 16, MAX_MEM_LEVEL,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closed_on_return(&stream, deflateEnd);
  std::string packed(deflateBound(&stream, contents.size()), '\0');
  std::size_t taken = 0;
  std::size_t filled = 0;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    constexpr std::size_t most_at_once = std::numeric_limits<uInt>::max();
    const auto input = std::min(contents.size() - taken, most_at_once);
    const auto room = std::min(packed.size() - filled, most_at_once);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(contents.data() + taken));
    stream.avail_in = static_cast<uInt>(input);
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + filled);
    stream.avail_out = static_cast<uInt>(room);
    status = deflate(&stream, taken + input == contents.size() ? Z_FINISH : Z_NO_FLUSH);
    taken += input - stream.avail_in;
    filled += room - stream.avail_out;
  }
  packed.resize(filled);
  return packed;
}

}  // namespace gyrostat
