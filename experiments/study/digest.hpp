#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

/// 64 bits of FNV-1a as 16 hexadecimal digits: tells one text from another, not from a forgery.
std::string digest(std::string_view bytes);

/// The same of what a file holds.
std::string file_digest(const std::filesystem::path& path);

/// Digest of all in a study's JSON that decides an outcome: its seed, and its cells with their
/// grids expanded, whatever the order of keys, and the contents of the recordings and fleets they
/// name. The title, the numbers of trials, what counts as a failure and the failure budget decide
/// none. `path` is the study file's.
std::string study_digest(const Json& study, const std::string& path);

}  // namespace gyrostat
