#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

struct CsvColumn;

/// The vectors of a MATLAB file, version 5 or 7.3.
struct MatColumns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;

  /// Moves column i to `*targets[i]` where that is not null. Throws InputError at `place` where
  /// they are of unequal lengths or hold an infinity.
  void take(std::span<std::vector<double>* const> targets, const std::string& place);
};

/// Whether a file is a MATLAB file, by its name.
bool is_mat_file(const std::filesystem::path& path);

/// Every real numeric vector: variables by their names, fields of structs by theirs ("s.field"
/// where the name is taken), columns of a matrix as "name(:,k)". Throws InputError where the file
/// cannot be read.
MatColumns read_mat(const std::filesystem::path& path);

/// Writes columns of equal length as variables of a MATLAB 5 file with compression, whose bytes
/// depend on nothing else. What is no letter, digit or underscore in a name becomes "_". Texts
/// become numbers from 1 and, beside them, `<name>_names`, a cell array of what they stand for.
void write_mat(const std::filesystem::path& path, std::span<const CsvColumn> columns);

}  // namespace gyrostat
