#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <gyrostat/core/temporary_path.hpp>

namespace gyrostat {

/// A file that is written piece by piece and comes into being whole or not at all: the pieces go to
/// a temporary beside it, which is renamed once it is on disk and removed when anything fails, so a
/// previous file stays until then. What a killed program left of it is taken over by the next. A
/// symbolic link is followed; a pipe or a device is written to directly. Every member throws
/// std::runtime_error with the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view piece);
  void commit();

 private:
  void require(bool done) const;

  std::filesystem::path path_, target_;
  TemporaryPath temporary_;  ///< none for a pipe or a device
  std::FILE* file_ = nullptr;
};

/// Puts `contents` at `path` whole or not at all, as an AtomicFile.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

/// Packs text piece by piece; equal text gives equal bytes, for no time is stored.
class Gzip {
 public:
  using Sink = std::function<void(std::string_view packed)>;

  explicit Gzip(Sink sink);
  ~Gzip();
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;

  void write(std::string_view piece);
  void finish();

 private:
  void pack(int flush);

  Sink sink_;
  std::string waiting_;  ///< packed in blocks of one size, however the text was cut
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// `contents` as gzip.
std::string gzipped(std::string_view contents);

}  // namespace gyrostat
