#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gyrostat {

/// Puts `contents` at `path` whole or not at all: they go to a temporary beside it, which is
/// renamed once it is on disk and removed when anything fails, so a previous file stays until then.
/// A symbolic link is followed; a pipe or a device is written to directly. Throws InputError with
/// the system's reason.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

/// `contents` as gzip; equal contents give equal bytes, for no time is stored.
std::string gzipped(std::string_view contents);

}  // namespace gyrostat
