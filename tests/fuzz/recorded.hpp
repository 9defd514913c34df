#pragma once

#include <filesystem>
#include <string>

namespace gyrostat::fuzz {

/// The z axis of a recording on an even clock, as every verb takes it: by the format that is named,
/// whatever the first bytes say, or by what they say where none is.
void read_z(const std::filesystem::path& path, const std::string& format = "");

}  // namespace gyrostat::fuzz
