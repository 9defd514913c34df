#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace gyrostat {

/// Where the write-ahead log beside a database is damaged, in bytes from its start: there is a
/// commit behind that place which SQLite, since a checksum before it fails, leaves out without a
/// word. Nothing for a log that merely ends unfinished, as a kill or a power cut leaves it.
///
/// Source: the SQLite database file format, section 4,
/// https://sqlite.org/fileformat2.html#walformat
std::optional<std::uint64_t> damage_of_log(const std::filesystem::path& database);

}  // namespace gyrostat
