#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gyrostat {

class InputFile;

/// A text in blocks of whole lines, so that a file of any length needs little memory. UTF-16 (known
/// by its byte order mark, or by its zeros) comes out as UTF-8; any other zero byte, and a line
/// beyond 16 MiB, is an InputError.
class LineBlocks {
 public:
  explicit LineBlocks(InputFile& file);
  /// The next lines, which live until the next call; empty at the end.
  std::string_view next();

 private:
  enum class Encoding { bytes, utf16_little, utf16_big };
  std::size_t fill(char* to, std::size_t most);

  InputFile& file_;
  Encoding encoding_ = Encoding::bytes;
  std::string block_, raw_;
  std::size_t used_ = 0, filled_ = 0;
  std::uint64_t before_ = 0;
  unsigned high_surrogate_ = 0;
};

}  // namespace gyrostat
