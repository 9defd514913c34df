#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

class InputFile;

/// The whole text of a file, as an InputFile has it. Throws InputError where it is empty, not text
/// (it holds a zero byte), or more than 1 GiB.
std::string read_text(const std::filesystem::path& path);

/// `text` from a file as ASCII that can go to a terminal or into JSON: any other byte becomes '?'.
std::string printable(std::string_view text);

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

/// What stands above the rows of a CSV.
struct CsvHeader {
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< of a second line that has units, without brackets; or empty
  char separator = ',';            ///< or ';', a tab, or ' ' for blanks
  std::size_t line = 1;            ///< of the names, from 1
  std::size_t first_row = 2;       ///< line of the first row
  bool numbered = false;           ///< there are no names: columns are called 1, 2, …
};

/// Cuts the header off the front of a CSV, with a byte order mark and with lines of comment (#, %,
/// //) or nothing above it. Where the first other line is a row of numbers, the names are in the
/// last comment that has as many cells, and without one the columns are numbered from 1. Throws
/// InputError when a name appears twice or there are more than 10,000.
CsvHeader take_header(std::string_view& csv, std::string_view place);

/// What is in the rows of a CSV and is no plain number.
struct CsvOddities {
  std::size_t infinite = 0;       ///< values taken as missing
  std::size_t infinite_line = 0;  ///< of the first
  bool calendar_times = false;    ///< times were dates: they count from 1970 in seconds
};

/// The rows below a header, fed in blocks of whole lines. Column i is appended to `*targets[i]`, or
/// skipped where that is null. A blank cell, NaN, NA, null, and an infinity are no value; where
/// commas do not separate they may be decimal; `times` may hold dates (ISO 8601). Throws InputError
/// with line, column and value for a cell that is none of these, a row of another length than the
/// header, and a blank line that is not at the end.
class CsvRows {
 public:
  CsvRows(const CsvHeader& header, std::span<std::vector<double>* const> targets,
          std::string_view place, const std::vector<double>* times = nullptr);
  void feed(std::string_view lines);
  const CsvOddities& oddities() const { return oddities_; }

 private:
  struct Row;
  void read_row(const Row& row);
  double odd_cell(std::string_view cell, std::size_t column, const Row& row);

  const CsvHeader& header_;
  std::vector<std::vector<double>*> targets_;
  std::string_view place_;
  const std::vector<double>* times_;
  std::size_t line_, blank_ = 0;
  CsvOddities oddities_;
};

}  // namespace gyrostat
