#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/binary/cursor.hpp>
#include <gyrostat/recordings/binary/unpack.hpp>
#include <gyrostat/recordings/binary/whole_file.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat::formats::numpy {
namespace {

constexpr std::string_view magic("\x93NUMPY", 6);
constexpr std::size_t most_columns = 64;

struct Field {
  std::string name, type;  ///< type as "<f8"
  std::size_t count = 1;
};

/// What stands behind `key` in the header's dictionary.
std::string_view behind(std::string_view header, std::string_view key) {
  const auto at = header.find(key);
  if (at == header.npos) return {};
  auto rest = header.substr(at + key.size());
  while (!rest.empty() && (rest[0] == ' ' || rest[0] == ':' || rest[0] == '\'' || rest[0] == '"'))
    rest.remove_prefix(1);
  return rest;
}

std::string quoted(std::string_view& text) {
  const auto open = text.find_first_of("'\"");
  if (open == text.npos) return "";
  const auto close = text.find(text[open], open + 1);
  if (close == text.npos) return "";
  std::string found(text.substr(open + 1, close - open - 1));
  text.remove_prefix(close + 1);
  return found;
}

/// The numbers in "(100, 3)".
std::vector<std::uint64_t> numbers_in(std::string_view text) {
  std::vector<std::uint64_t> numbers;
  const char* at = text.data();
  const char* const end = at + std::min(text.find(')'), text.size());
  while (at < end) {
    std::uint64_t number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error == std::errc()) numbers.push_back(number);
    at = stop == at ? at + 1 : stop;
  }
  return numbers;
}

/// [('t', '<f8'), ('gyro', '<f4', (3,))]
std::vector<Field> record_fields(std::string_view text) {
  std::vector<Field> fields;
  text = text.substr(0, text.find(']'));
  while (fields.size() < most_columns) {
    Field field{quoted(text), quoted(text)};
    if (field.name.empty() || field.type.empty()) break;
    const auto next = std::min(text.find('\''), text.size());
    if (const auto open = text.find('('); open < text.find(')') && open < next)
      for (const auto number : numbers_in(text.substr(open)))
        field.count = static_cast<std::size_t>(std::min<std::uint64_t>(number, most_columns + 1));
    fields.push_back(std::move(field));
  }
  return fields;
}

std::size_t size_of(const std::string& type) {
  const bool known = type.size() == 3 &&
                     std::string_view("<>|=").find(type[0]) != std::string::npos &&
                     std::string_view("fiub").find(type[1]) != std::string::npos &&
                     std::string_view("1248").find(type[2]) != std::string::npos;
  return known && !(type[1] == 'f' && type[2] < '4') ? static_cast<std::size_t>(type[2] - '0') : 0;
}

double number(const std::string& type, const char* from) {
  std::array<char, 8> bytes{};
  const auto size = size_of(type);
  std::copy_n(from, size, bytes.begin());
  if (type[0] == '>')
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  const Cursor at({bytes.data(), size});
  const auto as = [&]<class T>(T) { return static_cast<double>(Cursor(at).number<T>()); };
  switch (type[1] * 16 + type[2] - '0') {
    case 'f' * 16 + 4:
      return as(float{});
    case 'f' * 16 + 8:
      return as(double{});
    case 'i' * 16 + 1:
      return as(std::int8_t{});
    case 'i' * 16 + 2:
      return as(std::int16_t{});
    case 'i' * 16 + 4:
      return as(std::int32_t{});
    case 'i' * 16 + 8:
      return as(std::int64_t{});
    case 'u' * 16 + 2:
      return as(std::uint16_t{});
    case 'u' * 16 + 4:
      return as(std::uint32_t{});
    case 'u' * 16 + 8:
      return as(std::uint64_t{});
    default:
      return as(std::uint8_t{});
  }
}

/// One array: a vector under `name` ("1" where it has none), a matrix as name(:,k) (or k), a record
/// array by its fields.
void add_array(std::string_view bytes, const std::string& name, const std::string& place,
               ColumnTable& table) {
  const auto require = [&](bool holds, const std::string& problem) {
    if (!holds) throw InputError(place, (name.empty() ? "" : name + ": ") + problem);
  };
  Cursor at(bytes);
  require(at.bytes(magic.size()) == magic, "is no NumPy array");
  const auto version = at.number<std::uint8_t>();
  at.bytes(1);
  const auto length = version == 1 ? at.number<std::uint16_t>() : at.number<std::uint32_t>();
  const auto header = at.bytes(length);
  const auto shape = numbers_in(behind(header, "'shape'"));
  const bool by_columns = behind(header, "'fortran_order'").starts_with("True");
  auto described = behind(header, "'descr'");
  const bool records = described.starts_with('[');
  const auto key = header.find("'descr'");
  require(key != header.npos, "has no 'descr' in its header");
  if (!records) described = header.substr(key + 7);
  const auto fields =
      records ? record_fields(described) : std::vector<Field>{{"", quoted(described)}};
  require(!fields.empty() && shape.size() <= 2 && !(records && shape.size() != 1),
          "has a shape that is no table; allowed: a vector, a matrix or a record array");
  const std::uint64_t rows = shape.empty() ? 1 : shape[0];
  const std::uint64_t across = shape.size() == 2 ? shape[1] : 1;
  std::uint64_t row_bytes = 0;
  for (const auto& field : fields) {
    require(size_of(field.type) > 0 && field.count <= most_columns,
            fmt::format("has values of type '{}'; allowed: real numbers",
                        printable(field.type.substr(0, 20))));
    row_bytes += size_of(field.type) * field.count;
  }
  require(across <= most_columns, fmt::format("has {} columns; allowed: up to 64", across));
  require(row_bytes * across == 0 || rows <= at.size() / (row_bytes * across),
          "is cut off: fewer values than its shape says");
  const char* const data = at.rest().data();
  std::uint64_t offset = 0;
  for (const auto& field : fields) {
    const auto size = size_of(field.type);
    const std::uint64_t columns = records ? field.count : across;
    for (std::uint64_t k = 0; k < columns; ++k) {
      std::vector<double> values(static_cast<std::size_t>(rows));
      for (std::uint64_t row = 0; row < rows; ++row)
        values[static_cast<std::size_t>(row)] =
            number(field.type, data + (records      ? row * row_bytes + offset + k * size
                                       : by_columns ? (k * rows + row) * size
                                                    : (row * across + k) * size));
      const auto base = records ? field.name : name;
      const bool numbered = columns > 1 || base.empty();
      table.add(!numbered      ? base
                : base.empty() ? std::to_string(k + 1)
                               : fmt::format("{}(:,{})", base, k + 1),
                std::move(values));
    }
    offset += size * field.count;
  }
}

/// The arrays of an .npz, which is a ZIP archive (PKWARE's APPNOTE), by its central directory.
void add_archive(std::string_view bytes, const std::string& place, ColumnTable& table) {
  constexpr std::uint32_t end_mark = 0x06054b50, entry_mark = 0x02014b50, wide = 0xffffffff;
  const auto end = bytes.rfind(std::string_view("PK\x05\x06", 4));
  if (end == bytes.npos) throw CutOff();
  Cursor tail(bytes.substr(end));
  if (tail.number<std::uint32_t>() != end_mark) throw CutOff();
  tail.bytes(6);
  const auto entries = tail.number<std::uint16_t>();
  tail.bytes(4);
  const auto directory = tail.number<std::uint32_t>();
  Cursor at(bytes);
  at.bytes(directory);
  Unpacker unpacker(place);
  for (unsigned i = 0; i < entries; ++i) {
    if (at.number<std::uint32_t>() != entry_mark) throw CutOff();
    at.bytes(6);
    const auto method = at.number<std::uint16_t>();
    at.bytes(8);
    const auto packed_size = at.number<std::uint32_t>(), size = at.number<std::uint32_t>();
    const auto name_size = at.number<std::uint16_t>(), extra = at.number<std::uint16_t>(),
               comment = at.number<std::uint16_t>();
    at.bytes(8);
    const auto local = at.number<std::uint32_t>();
    auto name = at.bytes(name_size);
    at.bytes(extra + comment);
    if (!name.ends_with(".npy")) continue;
    name.remove_suffix(4);
    if (packed_size == wide || size == wide || (method != 0 && method != 8))
      throw InputError(place, fmt::format("'{}' is packed by a way other than numpy.savez and "
                                          "savez_compressed",
                                          printable(name)));
    Cursor entry(bytes);
    entry.bytes(local + std::uint64_t{26});
    const auto local_name = entry.number<std::uint16_t>(),
               local_extra = entry.number<std::uint16_t>();
    entry.bytes(local_name + local_extra);
    add_array(unpacker.unpack(entry.bytes(packed_size), method == 0 ? "none" : "deflate", size),
              printable(name), place, table);
  }
}

ColumnTable read(const FormatSource& source) {
  const WholeFile file(source);
  ColumnTable table;
  try {
    if (file.bytes().starts_with(magic))
      add_array(file.bytes(), "", source.place, table);
    else
      add_archive(file.bytes(), source.place, table);
  } catch (const CutOff&) {
    throw InputError(source.place, "is cut off or damaged: it ends within an array");
  }
  if (table.names.empty()) throw InputError(source.place, "holds no array");
  return table;
}

/// An archive is NumPy's where its first file is an array.
bool recognises(const FormatHead& head) {
  if (head.starts_with(magic)) return true;
  if (!head.starts_with("PK\x03\x04") || head.bytes.size() < 30) return false;
  const auto length = static_cast<unsigned char>(head.bytes[26]);
  return head.bytes.substr(30, length).ends_with(".npy");
}

}  // namespace

/// NumPy's .npy and .npz (numpy.lib.format): vectors by their names, columns of matrices as
/// name(:,k), of a lone matrix by their numbers, record arrays by their fields.
RecordingFormat format() {
  return {.title = "NumPy (.npy, .npz): vectors, matrices and record arrays",
          .recognises = recognises,
          .read = read};
}

}  // namespace gyrostat::formats::numpy
