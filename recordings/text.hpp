#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gyrostat {

/// The whole text of a file, as an InputFile has it. Throws InputError where it is empty, not text
/// (it holds a zero byte), or more than 1 GiB.
std::string read_text(const std::filesystem::path& path);

/// `text` from a file as ASCII that can go to a terminal or into JSON: any other byte becomes '?'.
std::string printable(std::string_view text);

}  // namespace gyrostat
