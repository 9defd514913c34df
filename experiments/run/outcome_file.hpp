#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// Creates the folder and its parents; InputError when that fails or it cannot be written to.
void make_result_folder(const std::filesystem::path& folder);

/// Throws InputError where `path` cannot become a file, or is the very file `input`: before any
/// work is done for it.
void require_writable(const std::filesystem::path& path, const std::filesystem::path& input);

/// Takes text piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// The canonical export: every finished trial of the store as a row "cell,trial,method,<metrics>,
/// <statuses>,diverged", ordered by cell, trial and method; a number without a value is blank. Only
/// trials below the number that the store was last asked for. The same bytes for the same outcomes,
/// whoever made them, in whatever order.
void export_outcomes(const Store& store, const TextSink& sink);

/// The export, packed, at `path`: whole or not at all.
void write_outcomes(const std::filesystem::path& path, const Store& store);

}  // namespace gyrostat
