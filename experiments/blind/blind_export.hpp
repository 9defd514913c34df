#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>

namespace gyrostat::gap {

struct BlindCheck;

/// A blind check for others, whose method is to be compared: recordings, how to answer, and the
/// labels with the check itself, sealed. Returns the key that opens them. InputError where the
/// folder has something already.
std::string export_recordings(const BlindCheck& check, const std::filesystem::path& folder);

/// Opens the seal of an exported folder and scores answers: NNNNN.json for recording NNNNN, what
/// `gyrostat diagnose --json` writes or a part of it. InputError where there is no answer, or one
/// that is none, or the key is another's.
std::vector<NamedTable> score_answers(const std::filesystem::path& folder,
                                      const std::filesystem::path& answers, const std::string& key);

}  // namespace gyrostat::gap
