#include <gyrostat/recordings/matlab.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/column_table.hpp>
#include <gyrostat/recordings/matlab_integrity.hpp>
#include <gyrostat/recordings/matlab_library.hpp>
#include <gyrostat/recordings/temporary_folder.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

struct Closed {
  void operator()(mat_t* file) const { matlab_library().close(file); }
  void operator()(matvar_t* variable) const { matlab_library().free(variable); }
};
using File = std::unique_ptr<mat_t, Closed>;
using Variable = std::unique_ptr<matvar_t, Closed>;

template <class T>
void append(const matvar_t& from, std::size_t first, std::size_t count, std::vector<double>& to) {
  const auto* values = static_cast<const T*>(from.data) + first;
  for (std::size_t i = 0; i < count; ++i) to.push_back(static_cast<double>(values[i]));
}

/// Column `index` of a numeric matrix; false for any other variable.
bool append_numbers(const matvar_t& from, std::size_t index, std::size_t rows,
                    std::vector<double>& to) {
  const auto first = index * rows;
  switch (from.data_type) {
    case MAT_T_DOUBLE:
      append<double>(from, first, rows, to);
      return true;
    case MAT_T_SINGLE:
      append<float>(from, first, rows, to);
      return true;
    case MAT_T_INT8:
      append<std::int8_t>(from, first, rows, to);
      return true;
    case MAT_T_UINT8:
      append<std::uint8_t>(from, first, rows, to);
      return true;
    case MAT_T_INT16:
      append<std::int16_t>(from, first, rows, to);
      return true;
    case MAT_T_UINT16:
      append<std::uint16_t>(from, first, rows, to);
      return true;
    case MAT_T_INT32:
      append<std::int32_t>(from, first, rows, to);
      return true;
    case MAT_T_UINT32:
      append<std::uint32_t>(from, first, rows, to);
      return true;
    case MAT_T_INT64:
      append<std::int64_t>(from, first, rows, to);
      return true;
    case MAT_T_UINT64:
      append<std::uint64_t>(from, first, rows, to);
      return true;
    default:
      return false;
  }
}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 &&
         !variable.isComplex && variable.rank == 2 && variable.data;
}

void add_matrix(const matvar_t& variable, const std::string& name, ColumnTable& columns) {
  const bool is_vector = variable.dims[0] == 1 || variable.dims[1] == 1;
  const auto rows = is_vector ? variable.dims[0] * variable.dims[1] : variable.dims[0];
  const auto count = is_vector ? 1 : variable.dims[1];
  constexpr std::size_t most_columns = 64;  // beyond which it is no list of columns
  if (rows == 0 || count > most_columns || rows * count * variable.data_size != variable.nbytes)
    return;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> values;
    values.reserve(rows);
    if (!append_numbers(variable, k, rows, values)) return;
    columns.names.push_back(is_vector ? name : fmt::format("{}(:,{})", name, k + 1));
    columns.values.push_back(std::move(values));
  }
}

void add_variable(matvar_t& variable, const std::string& within, ColumnTable& columns) {
  if (!variable.name) return;
  std::string name = variable.name;
  if (std::ranges::find(columns.names, name) != columns.names.end()) name = within + name;
  if (is_numeric(variable)) add_matrix(variable, name, columns);
  const bool is_one_struct = variable.class_type == MAT_C_STRUCT && variable.rank == 2 &&
                             variable.dims[0] == 1 && variable.dims[1] == 1;
  if (!is_one_struct) return;
  for (unsigned k = 0; k < matlab_library().number_of_fields(&variable); ++k)
    if (auto* field = matlab_library().field(&variable, k, 0))
      add_variable(*field, within + variable.name + ".", columns);
}

/// A name that MATLAB takes for a variable: at most 63 letters, digits and underscores.
std::string variable_name(const std::string& column) {
  std::string name = column;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name.front()))) name = "x" + name;
  return name.substr(0, 63);
}

Variable column_of(const std::string& name, std::vector<double>& values) {
  std::array<std::size_t, 2> shape = {values.size(), 1};
  return Variable(matlab_library().variable(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2,
                                            shape.data(), values.data(), 0));
}

Variable names_of(const std::string& name, const std::vector<std::string_view>& texts) {
  std::array<std::size_t, 2> shape = {texts.size(), 1};
  Variable list(
      matlab_library().variable(name.c_str(), MAT_C_CELL, MAT_T_CELL, 2, shape.data(), nullptr, 0));
  for (std::size_t i = 0; list && i < texts.size(); ++i) {
    std::array<std::size_t, 2> length = {1, texts[i].size()};
    std::string text(texts[i]);
    matlab_library().set_cell(list.get(), static_cast<int>(i),
                              matlab_library().variable(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2,
                                                        length.data(), text.data(), 0));
  }
  return list;
}

void write_variables(mat_t* file, std::span<const CsvColumn> columns) {
  // Cells are not compressed: matio 1.5.23 then states wrong lengths for them.
  const auto write = [&](const Variable& variable) {
    const auto packing = variable && variable->class_type == MAT_C_CELL ? MAT_COMPRESSION_NONE
                                                                        : MAT_COMPRESSION_ZLIB;
    if (!variable || matlab_library().write(file, variable.get(), packing) != 0)
      throw std::runtime_error("the MATLAB file cannot be written");
  };
  std::vector<std::string> used;
  for (const auto& column : columns) {
    const auto name = variable_name(column.name);
    if (std::ranges::find(used, name) != used.end())
      throw InputError(column.name,
                       fmt::format("stands twice as MATLAB has it, '{}'; write CSV", name));
    used.push_back(name);
    std::vector<double> values(column.values.begin(), column.values.end());
    std::vector<std::string_view> texts;
    if (column.values.empty())
      for (const auto text : column.texts) {
        const auto known = std::ranges::find(texts, text);
        values.push_back(static_cast<double>(known - texts.begin() + 1));
        if (known == texts.end()) texts.push_back(text);
      }
    write(column_of(name, values));
    if (!texts.empty()) write(names_of(variable_name(column.name + "_names"), texts));
  }
}

}  // namespace

bool is_mat_file(const fs::path& path) { return path.extension() == ".mat"; }

ColumnTable read_mat(const fs::path& path) {
  const auto place = path.string();
  if (!fs::exists(path)) throw InputError(place, "cannot be read: No such file or directory");
  if (!fs::is_regular_file(path)) throw InputError(place, "is no file");
  require_whole_mat(path);
  const File file(matlab_library().open(place.c_str(), MAT_ACC_RDONLY));
  if (!file) throw InputError(place, "cannot be read as a MATLAB file");
  ColumnTable columns;
  while (Variable variable{matlab_library().read_next(file.get())})
    add_variable(*variable, "", columns);
  if (columns.names.empty())
    throw InputError(place,
                     "has no numeric vector; required: t_s and gyro_dps as variables, or as fields "
                     "of a struct (a table or timetable cannot be read: use table2struct)");
  return columns;
}

void write_mat(const fs::path& path, std::span<const CsvColumn> columns) {
  const TemporaryFolder folder;
  const auto temporary = folder.path() / "variables.mat";
  {
    const File file(matlab_library().create(
        temporary.c_str(), "MATLAB 5.0 MAT-file, written by gyrostat", MAT_FT_MAT5));
    if (!file) throw InputError(path.string(), "cannot be written");
    write_variables(file.get(), columns);
  }
  std::ifstream written(temporary, std::ios::binary);
  write_atomically(path, std::string(std::istreambuf_iterator<char>(written), {}));
}

}  // namespace gyrostat
