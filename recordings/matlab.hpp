#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

struct ColumnTable;
struct CsvColumn;

/// Whether a file is a MATLAB file, by its name.
bool is_mat_file(const std::filesystem::path& path);

/// Every real numeric vector of a MATLAB file, version 5 or 7.3: variables by their names, fields
/// of structs by theirs ("s.field" where the name is taken), columns of a matrix as "name(:,k)".
/// Throws InputError where the file cannot be read.
ColumnTable read_mat(const std::filesystem::path& path);

/// Writes columns of equal length as variables of a MATLAB 5 file with compression, whose bytes
/// depend on nothing else. What is no letter, digit or underscore in a name becomes "_". Texts
/// become numbers from 1 and, beside them, `<name>_names`, a cell array of what they stand for.
void write_mat(const std::filesystem::path& path, std::span<const CsvColumn> columns);

}  // namespace gyrostat
