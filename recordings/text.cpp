#include <gyrostat/recordings/text.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <system_error>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <zlib.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/units.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::size_t first_bytes = std::size_t{1} << 16;
constexpr std::size_t most_columns = 10'000;
/// A recording packs ten- to thirtyfold, one that stands still fiftyfold; what packs better
/// has nothing in it but the wish to fill a memory.
constexpr std::size_t most_packing = 100, always_allowed = std::size_t{1} << 26;

/// Makes room behind the `filled` bytes of a growing text.
void grow(std::string& text, std::size_t filled, const std::string& place) {
  if (filled > most_bytes) throw InputError(place, "is too long; allowed: up to 1 GiB of text");
  if (filled == text.size()) text.resize(std::min(2 * filled, most_bytes + 1));
}

std::string read_bytes(const fs::path& path, const std::string& place) {
  std::error_code unknown;
  if (fs::is_directory(path, unknown)) {
    throw InputError(place, "is a directory; allowed: a CSV or CSV.gz file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.c_str(), "rb"), [](auto* f) { return std::fclose(f); });
  const auto fail = [&] {
    throw InputError(place, "cannot be read: " + std::generic_category().message(errno));
  };
  if (!file) fail();
  const auto size = fs::file_size(path, unknown);
  std::string bytes(unknown ? first_bytes : std::clamp(size + 1, first_bytes, most_bytes), '\0');
  std::size_t filled = 0;
  while (const auto got = std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get())) {
    filled += got;
    grow(bytes, filled, place);
  }
  if (std::ferror(file.get())) fail();
  bytes.resize(filled);
  return bytes;
}

std::string gunzipped(std::string& packed, const std::string& place) {
  z_stream stream{};
  if (inflateInit2(&stream, MAX_WBITS + 16) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closed_on_return(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());

  std::string text(std::max(first_bytes, std::min(5 * packed.size(), most_bytes)), '\0');
  std::size_t filled = 0;
  const auto most = std::max(always_allowed, most_packing * packed.size());
  for (bool done = false; !done;) {
    grow(text, filled, place);
    stream.next_out = reinterpret_cast<Bytef*>(text.data() + filled);
    stream.avail_out = static_cast<uInt>(text.size() - filled);
    const int status = inflate(&stream, Z_NO_FLUSH);
    filled = text.size() - stream.avail_out;
    if (filled > most)
      throw InputError(place, fmt::format("unpacks to more than {} bytes, {} times its size; "
                                          "allowed: up to {} times",
                                          most, filled / packed.size(), most_packing));
    if (status == Z_STREAM_END) {
      done = stream.avail_in == 0;
      inflateReset(&stream);
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError(place, fmt::format("the gzip data are corrupt after {} bytes of text: {}",
                                          filled, stream.msg ? stream.msg : zError(status)));
    } else if (stream.avail_in == 0 && stream.avail_out > 0) {
      throw InputError(place,
                       fmt::format("the gzip data are truncated after {} bytes of text", filled));
    }
  }
  text.resize(filled);
  return text;
}

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

const char* cell_end(const char* begin, const char* row_end, char separator) {
  const void* comma = std::memchr(begin, separator, static_cast<std::size_t>(row_end - begin));
  return comma ? static_cast<const char*>(comma) : row_end;
}

std::string shown(std::string_view text) {
  return printable(text.size() > 40 ? std::string(text.substr(0, 40)) + "..." : text);
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string> cells(
      static_cast<std::size_t>(std::count(line.begin(), line.end(), separator)) + 1);
  for (auto& cell : cells) cell = trimmed(take(line, separator));
  return cells;
}

/// The commonest of comma, semicolon and tab.
char separator_of(std::string_view line) {
  char commonest = ',';
  for (const char candidate : {';', '\t'})
    if (std::count(line.begin(), line.end(), candidate) >
        std::count(line.begin(), line.end(), commonest))
      commonest = candidate;
  return commonest;
}

/// How many characters make the line a comment: "#", "%" or "//"; 0 where it is none.
std::size_t comment_mark(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%') ? 1 : line.starts_with("//") ? 2 : 0;
}

struct Row {
  std::string_view cells, place;
  std::size_t line;
  char separator;

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}", place, line), problem);
  }
};

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

/// A cell that is not just a number: blank, padded, quoted, with a plus sign or a decimal comma, or
/// wrong.
double odd_cell(std::string_view cell, const std::string& name, const Row& row) {
  std::string_view number = trimmed(cell);
  if (number.empty()) return no_value;
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  if (const auto value = number_in(number)) return *value;
  if (const auto value = number_in(number, ','); value && row.separator != ',') return *value;
  row.fail(
      fmt::format("column '{}': '{}' is not a number; allowed: finite numbers, or a blank cell"
                  " for no value",
                  printable(name), shown(cell)));
}

void read_row(const Row& row, std::span<const std::string> names,
              std::span<std::vector<double>* const> targets) {
  const char* cell = row.cells.data();
  const char* const row_end = cell + row.cells.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const char* end = nullptr;
    if (targets[i]) {
      double value = no_value;
      const auto [stop, error] = fast_float::from_chars(cell, row_end, value);
      end = stop;
      if (error != std::errc() || (end != row_end && *end != row.separator) ||
          !std::isfinite(value)) {
        end = cell_end(cell, row_end, row.separator);
        value = odd_cell({cell, static_cast<std::size_t>(end - cell)}, names[i], row);
      }
      targets[i]->push_back(value);
    } else {
      end = cell_end(cell, row_end, row.separator);
    }
    if ((end == row_end) != (i + 1 == names.size())) {
      row.fail(fmt::format(
          "'{}' has {} cells; allowed: {}, as many as the header", shown(row.cells),
          std::count(row.cells.begin(), row.cells.end(), row.separator) + 1, names.size()));
    }
    cell = end + 1;
  }
}

}  // namespace

std::string read_text(const fs::path& path) {
  const std::string place = path.string();
  std::string text;
  try {
    text = read_bytes(path, place);
    if (text.starts_with("\x1f\x8b")) text = gunzipped(text, place);
  } catch (const std::bad_alloc&) {
    throw InputError(place, "is too long for the memory that there is");
  }
  if (text.empty()) throw InputError(place, "is empty; allowed: a header and at least one sample");
  if (const auto zero = text.find('\0'); zero != std::string::npos) {
    throw InputError(place, fmt::format("is not text: byte {} is zero", zero));
  }
  return text;
}

std::string printable(std::string_view text) {
  std::string ascii(text);
  std::replace_if(
      ascii.begin(), ascii.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return ascii;
}

CsvHeader take_header(std::string_view& csv, std::string_view place) {
  if (csv.starts_with("\xef\xbb\xbf")) csv.remove_prefix(3);
  CsvHeader header;
  std::string_view comment;
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
  const auto columns =
      static_cast<std::size_t>(std::count(first.begin(), first.end(), header.separator)) + 1;
  if (columns > most_columns)
    throw InputError(fmt::format("{}:{}", place, header.line),
                     fmt::format("{} columns; allowed: up to {}", columns, most_columns));
  header.names = cells_of(first, header.separator);
  if (!comment.empty() && number_in(header.names.front())) {
    header.names = cells_of(comment, header.separator);
    header.first_row = header.line--;
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
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    throw InputError(fmt::format("{}:{}", place, header.line),
                     fmt::format("column '{}' appears twice; allowed: once", shown(*twice)));
  }
  return header;
}

void read_columns(std::string_view rows, const CsvHeader& header,
                  std::span<std::vector<double>* const> targets, std::string_view place) {
  const auto most_rows = static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')) + 1;
  for (auto* target : targets) {
    if (target) target->reserve(most_rows);
  }
  for (std::size_t line = header.first_row; !rows.empty(); ++line) {
    Row row{take(rows, '\n'), place, line, header.separator};
    if (row.cells.ends_with('\r')) row.cells.remove_suffix(1);
    if (trimmed(row.cells).empty()) {
      if (trimmed(rows).empty()) return;
      row.fail("is blank; allowed: blank lines at the end only");
    }
    read_row(row, header.names, targets);
  }
}

}  // namespace gyrostat
