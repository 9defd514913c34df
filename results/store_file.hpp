#pragma once

#include <filesystem>

#include <gyrostat/results/store.hpp>

/// A store as a file beside its log: how it is made whole, refused and put out of the way.
namespace gyrostat::store_file {

/// One line for what SQLite says: what happened, and what to do.
StoreError explained(const sqlite::Error& error);

/// Puts a whole store where there is none.
void create(const std::filesystem::path& path, const Manifest& manifest);

/// Throws StoreError where it is not a store of this version.
void require_version(sqlite::Database& database);

/// Throws StoreError where trials in the log would be lost without a word.
void require_sound_log(const std::filesystem::path& path);

/// Gives a store and its log a name that is free, and returns it.
std::filesystem::path renamed(const std::filesystem::path& path);

}  // namespace gyrostat::store_file
