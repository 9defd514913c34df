#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace gyrostat {

/// The bytes of a file, a pipe or standard input ("-"), unpacked where they are a gzip of one or
/// more members (known by its first bytes, not by its name). They are read once, from front to
/// back. Every member throws InputError with the file's name: where it is missing, unreadable or a
/// directory, a truncated or corrupt gzip, or one that unpacks to more than text does (a bomb).
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// What messages call it.
  const std::string& place() const { return place_; }
  /// Up to 64 KiB from the front, which stay to be read.
  std::string_view head() const { return head_; }
  /// The next bytes, at most `most`; 0 at the end.
  std::size_t read(char* to, std::size_t most);
  /// All that is left, refused where it is more than `most` bytes.
  std::string rest(std::size_t most);
  /// Whether it may as well be opened by its name: a file, and not packed.
  bool is_plain() const;
  /// About how many bytes there are in all, unpacked; a guess.
  std::uintmax_t size_hint() const { return size_hint_; }

 private:
  std::size_t read_raw(char* to, std::size_t most);
  std::size_t read_unpacked(char* to, std::size_t most);

  std::filesystem::path path_;
  std::string place_, head_;
  std::size_t head_read_ = 0;
  std::uintmax_t size_hint_ = 0;
  struct Source;
  std::unique_ptr<Source> source_;
};

}  // namespace gyrostat
