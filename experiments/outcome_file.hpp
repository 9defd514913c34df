#pragma once

#include <filesystem>
#include <span>

#include "experiments/runner.hpp"

namespace gyrostat {

/// Creates the folder and its parents; InputError when that fails or it cannot be written to.
void make_result_folder(const std::filesystem::path& folder);

/// Throws InputError where `path` cannot become a file, or is the very file `input`: before any work
/// is done for it.
void require_writable(const std::filesystem::path& path, const std::filesystem::path& input);

/// Every finished trial as a row "cell,trial,method,<metrics>,<statuses>,diverged", ordered by
/// cell, trial and method: the same bytes for the same study. Written whole or not at all.
void write_outcomes(const std::filesystem::path& path, const Study& study,
                    std::span<const CellResult> results);

}  // namespace gyrostat
