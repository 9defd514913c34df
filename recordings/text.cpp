#include <gyrostat/recordings/text.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/calendar.hpp>
#include <gyrostat/recordings/input_file.hpp>
#include <gyrostat/recordings/units.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::size_t block_bytes = std::size_t{1} << 22, small_block = std::size_t{1} << 16,
                      longest_line = std::size_t{1} << 24;
constexpr std::size_t most_columns = 10'000;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\"";
  const auto first = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// Cuts `text` up to `separator` off its front.
std::string_view take(std::string_view& text, char separator) {
  const auto end = std::min(text.find(separator), text.size());
  const auto piece = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return piece;
}

/// Blanks and tabs alike where blanks separate.
bool separates(char c, char separator) { return c == separator || (separator == ' ' && c == '\t'); }

const char* cell_end(const char* begin, const char* row_end, char separator) {
  constexpr std::string_view blanks = " \t";
  if (separator == ' ') return std::find_first_of(begin, row_end, blanks.begin(), blanks.end());
  const void* comma = std::memchr(begin, separator, static_cast<std::size_t>(row_end - begin));
  return comma ? static_cast<const char*>(comma) : row_end;
}

/// Any run of blanks is one separator where blanks separate.
const char* cell_begin(const char* begin, const char* row_end, char separator) {
  while (separator == ' ' && begin != row_end && (*begin == ' ' || *begin == '\t')) ++begin;
  return begin;
}

std::string shown(std::string_view text) {
  return printable(text.size() > 40 ? std::string(text.substr(0, 40)) + "..." : text);
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  if (separator == ' ') line = trimmed(line);
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string> cells;
  const char* cell = line.data();
  const char* const end = cell + line.size();
  while (true) {
    cell = cell_begin(cell, end, separator);
    const char* stop = cell_end(cell, end, separator);
    cells.emplace_back(trimmed({cell, static_cast<std::size_t>(stop - cell)}));
    if (stop == end) return cells;
    cell = stop + 1;
  }
}

/// The commonest of comma, semicolon and tab; blanks where there is none of them.
char separator_of(std::string_view line) {
  char commonest = ',';
  for (const char candidate : {';', '\t'})
    if (std::count(line.begin(), line.end(), candidate) >
        std::count(line.begin(), line.end(), commonest))
      commonest = candidate;
  const bool blanks =
      std::count(line.begin(), line.end(), commonest) == 0 && trimmed(line).find(' ') != line.npos;
  return blanks ? ' ' : commonest;
}

/// How many characters make the line a comment: "#", "%" or "//"; 0 where it is none.
std::size_t comment_mark(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%') ? 1 : line.starts_with("//") ? 2 : 0;
}

/// The whole of `text` as a finite number, or nothing.
std::optional<double> number_in(std::string_view text, char decimal_point = '.') {
  double value = no_value;
  const char* end = text.data() + text.size();
  const auto [stop, error] = fast_float::from_chars_advanced(
      text.data(), end, value,
      fast_float::parse_options{fast_float::chars_format::general, decimal_point});
  return error == std::errc() && stop == end && std::isfinite(value) ? std::optional(value)
                                                                     : std::nullopt;
}

/// Whether cells are a row of values: the first that says anything is a number or a date.
bool is_row(const std::vector<std::string>& cells) {
  for (const auto& cell : cells)
    if (!cell.empty()) return number_in(cell) || number_in(cell, ',') || seconds_of_calendar(cell);
  return false;
}

/// The cells of a line that has a unit and no number, without brackets; nothing where it is
/// another.
std::vector<std::string> units_in(std::string_view line, const CsvHeader& header) {
  auto units = cells_of(line, header.separator);
  if (units.size() != header.names.size()) return {};
  bool has_unit = false;
  for (auto& unit : units) {
    if (number_in(unit) || number_in(unit, ',')) return {};
    if (const auto bare = split_unit(unit); bare.first.empty()) unit = bare.second;
    has_unit = has_unit || is_unit(unit);
    if (unit == "-") unit.clear();
  }
  return has_unit ? units : std::vector<std::string>{};
}

bool is_infinite(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text == "inf" || text == "Inf" || text == "INF" || text == "Infinity" ||
         text == "infinity";
}

/// What programs write for a number that is none.
bool is_no_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  for (const std::string_view word : {"nan", "NaN", "NAN", "Nan", "NA", "N/A", "null", "None"})
    if (text == word) return true;
  return false;
}

/// A small file needs no block of four megabytes, which takes longer to clear than the file to
/// read. How large one is that comes by a pipe is not known.
std::size_t first_block(const InputFile& file) {
  return file.size_hint() > 0 && 2 * file.size_hint() < small_block ? small_block : block_bytes;
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  InputFile file(path);
  std::string text = file.rest(most_bytes);
  if (text.empty())
    throw InputError(file.place(), "is empty; allowed: a header and at least one sample");
  if (const auto zero = text.find('\0'); zero != std::string::npos)
    throw InputError(file.place(), fmt::format("is not text: byte {} is zero", zero));
  return text;
}

std::string printable(std::string_view text) {
  std::string ascii(text);
  std::replace_if(
      ascii.begin(), ascii.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return ascii;
}

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

CsvHeader take_header(std::string_view& csv, std::string_view place) {
  if (csv.starts_with("\xef\xbb\xbf")) csv.remove_prefix(3);
  CsvHeader header;
  std::string_view comment = "";
  for (; !csv.empty(); ++header.line) {
    auto rest = csv;
    const auto line = trimmed(take(rest, '\n'));
    const auto mark = comment_mark(line);
    if (!line.empty() && mark == 0) break;
    if (mark > 0) comment = line.substr(mark);
    csv = rest;
  }
  auto names = csv;
  const auto first = take(names, '\n');
  header.separator = separator_of(first);
  // "time (sec)" above single numbers is one name.
  const auto second = trimmed(names.substr(0, names.find('\n')));
  if (header.separator == ' ' && !second.empty() && second.find_first_of(" \t") == second.npos)
    header.separator = separator_of(second);
  const auto columns =
      static_cast<std::size_t>(std::count(first.begin(), first.end(), header.separator)) + 1;
  if (columns > most_columns)
    throw InputError(fmt::format("{}:{}", place, header.line),
                     fmt::format("{} columns; allowed: up to {}", columns, most_columns));
  header.names = cells_of(first, header.separator);
  if (is_row(header.names)) {
    auto commented = cells_of(comment, header.separator);
    header.numbered = commented.size() != header.names.size() || is_row(commented);
    header.first_row = header.line;
    if (header.numbered)
      for (std::size_t i = 0; i < header.names.size(); ++i) header.names[i] = std::to_string(i + 1);
    else
      header.names = std::move(commented);
    if (!header.numbered) --header.line;
  } else {
    csv = names;
    header.first_row = header.line + 1;
    auto rows = csv;
    header.units = units_in(take(rows, '\n'), header);
    if (!header.units.empty()) csv = rows;
    if (!header.units.empty()) ++header.first_row;
  }
  auto sorted = header.names;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      twice != sorted.end() && !twice->empty()) {
    throw InputError(fmt::format("{}:{}", place, header.line),
                     fmt::format("column '{}' appears twice; allowed: once", shown(*twice)));
  }
  return header;
}

struct CsvRows::Row {
  std::string_view cells, place;
  std::size_t line;

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}", place, line), problem);
  }
};

CsvRows::CsvRows(const CsvHeader& header, std::span<std::vector<double>* const> targets,
                 std::string_view place, const std::vector<double>* times)
    : header_(header),
      targets_(targets.begin(), targets.end()),
      place_(place),
      times_(times),
      line_(header.first_row) {}

/// A cell that is not just a number: blank, padded, quoted, with a plus sign or a decimal comma, no
/// number by its own word, a date, or wrong.
double CsvRows::odd_cell(std::string_view cell, std::size_t column, const Row& row) {
  std::string_view number = trimmed(cell);
  if (number.empty() || is_no_number(number)) return no_value;
  if (is_infinite(number)) {
    if (oddities_.infinite++ == 0) oddities_.infinite_line = row.line;
    return no_value;
  }
  const bool is_time = times_ != nullptr && targets_[column] == times_;
  if (const auto moment = is_time ? seconds_of_calendar(number) : std::nullopt) {
    oddities_.calendar_times = true;
    return *moment;
  }
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  if (const auto value = number_in(number)) return *value;
  if (const auto value = number_in(number, ','); value && header_.separator != ',') return *value;
  row.fail(
      fmt::format("column '{}': '{}' is not a number; allowed: finite numbers{}, or a blank "
                  "cell or NaN for no value",
                  printable(header_.names[column]), shown(cell),
                  is_time ? ", dates as 2026-01-31T23:59:59.5" : ""));
}

void CsvRows::read_row(const Row& row) {
  const char separator = header_.separator;
  const char* cell = row.cells.data();
  const char* const row_end = cell + row.cells.size();
  const std::size_t count = header_.names.size();
  for (std::size_t i = 0; i < count; ++i) {
    cell = cell_begin(cell, row_end, separator);
    const char* end = nullptr;
    if (targets_[i]) {
      double value = no_value;
      const auto [stop, error] = fast_float::from_chars(cell, row_end, value);
      end = stop;
      if (error != std::errc() || (end != row_end && !separates(*end, separator)) ||
          !std::isfinite(value)) {
        end = cell_end(cell, row_end, separator);
        value = odd_cell({cell, static_cast<std::size_t>(end - cell)}, i, row);
      }
      targets_[i]->push_back(value);
    } else {
      end = cell_end(cell, row_end, separator);
    }
    if ((end == row_end) != (i + 1 == count)) {
      const auto cells = separator == ' '
                             ? static_cast<std::ptrdiff_t>(cells_of(row.cells, ' ').size())
                             : std::count(row.cells.begin(), row.cells.end(), separator) + 1;
      row.fail(fmt::format("'{}' has {} cells; allowed: {}, as many as the header",
                           shown(row.cells), cells, count));
    }
    cell = end + 1;
  }
}

void CsvRows::feed(std::string_view lines) {
  for (; !lines.empty(); ++line_) {
    Row row{take(lines, '\n'), place_, line_};
    if (row.cells.ends_with('\r')) row.cells.remove_suffix(1);
    if (header_.separator == ' ')
      while (row.cells.ends_with(' ') || row.cells.ends_with('\t')) row.cells.remove_suffix(1);
    if (trimmed(row.cells).empty()) {
      if (blank_ == 0) blank_ = line_;
      continue;
    }
    if (blank_ > 0) Row{{}, place_, blank_}.fail("is blank; allowed: blank lines at the end only");
    read_row(row);
  }
}

}  // namespace gyrostat
