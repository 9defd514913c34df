#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

/// The whole text of a file, a pipe, or a gzip of one or more members (known by its first bytes,
/// not by its name). Throws InputError when the file is missing, unreadable, a directory, empty,
/// not text (it holds a zero byte), a truncated or corrupt gzip, or more than 1 GiB once unpacked.
std::string read_text(const std::filesystem::path& path);

/// `text` from a file as ASCII that can go to a terminal or into JSON: any other byte becomes '?'.
std::string printable(std::string_view text);

/// Cuts the header line off the front of a CSV and returns its names; a byte order mark is skipped.
/// Throws InputError when a name appears twice.
std::vector<std::string> take_header(std::string_view& csv, std::string_view place);

/// Appends column i of the rows below a header to `*targets[i]`, or skips it where that is null. A
/// blank cell is NaN. Throws InputError with line, column and value for a cell that is not a finite
/// number, a row of another length than the header, and a blank line that is not at the end.
void read_columns(std::string_view rows, std::span<const std::string> names,
                  std::span<std::vector<double>* const> targets, std::string_view place);

}  // namespace gyrostat
