#include <gyrostat/results/store_file.hpp>

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <sqlite3.h>

#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/results/schema.hpp>
#include <gyrostat/results/store_log.hpp>
#include <gyrostat/results/store_rows.hpp>

namespace gyrostat::store_file {
namespace {

namespace fs = std::filesystem;
using sqlite::Access;
using sqlite::Database;
using sqlite::Transaction;

constexpr std::int64_t schema_version = 2;

/// A store is made whole, so one without tables has lost them.
StoreError emptied(const fs::path& path) {
  return StoreError(path.string() +
                    ": is empty, and a store never is: what it held is lost; gyrostat run "
                    "--set-aside keeps it under another name and begins anew");
}

StoreError of_other_version(const fs::path& path) {
  return StoreError(path.string() +
                    ": is not a store of this version of gyrostat; gyrostat run --set-aside keeps "
                    "it under another name and begins anew");
}

fs::path log_of(const fs::path& path) { return path.string() + "-wal"; }

}  // namespace

StoreError explained(const sqlite::Error& error) {
  const auto& path = error.path();
  std::string reason = error.what();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  const auto said = [&](const char* what, const char* advice) {
    return StoreError(fmt::format("{}: {} ({}); {}", path.string(), what, reason, advice));
  };
  constexpr const char* again = "finished trials are kept, and the same command goes on from them";
  if (error.is_damage())
    return StoreError(
        fmt::format("{}: is damaged ({}); gyrostat repair {} keeps what is sound, gyrostat run "
                    "--set-aside keeps "
                    "it under another name and begins anew",
                    path.string(), reason, path.parent_path().string()));
  switch (error.code() & 0xff) {
    case SQLITE_FULL:
      return said("the disk is full", again);
    case SQLITE_IOERR:
      return said("the disk does not take it", again);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return said("is in use by another program", again);
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
    case SQLITE_CANTOPEN:
      return said("cannot be opened", "may this user read and write the folder?");
    default:
      return said("failed", again);
  }
}

fs::path renamed(const fs::path& path) {
  int number = 1;
  fs::path aside;
  do aside = path.parent_path() / fmt::format("store-{}.db", number++);
  while (fs::exists(aside));
  // The log goes first: without its database it is nothing, the database without it is older.
  if (fs::exists(log_of(path))) fs::rename(log_of(path), log_of(aside));
  fs::remove(path.string() + "-shm");
  fs::rename(path, aside);
  return aside;
}

void require_version(Database& database) {
  const auto version = database.number("PRAGMA user_version");
  if (version == 0 && database.number("SELECT count(*) FROM sqlite_master") == 0)
    throw emptied(database.path());
  if (version != schema_version) throw of_other_version(database.path());
}

void require_sound_log(const fs::path& path) {
  if (const auto at = damage_of_log(path))
    throw StoreError(
        fmt::format("{}-wal: is damaged at byte {}, and the trials written after it are lost; "
                    "gyrostat repair {} "
                    "keeps those before, and gyrostat run makes the others again",
                    path.string(), *at, path.parent_path().string()));
}

void create(const fs::path& path, const Manifest& manifest) {
  std::error_code absent;
  if (fs::exists(log_of(path)) && fs::file_size(log_of(path), absent) > 0)
    throw StoreError(fmt::format(
        "{}: is gone, and its log {} is still there; put it back, or remove the log to begin anew",
        path.string(), log_of(path).filename().string()));
  TemporaryPath part(path.string() + ".tmp");
  fs::remove(part.path());
  {
    Database database(part.path(), Access::write);
    // Rows of some KiB fill large pages better. What is not whole goes: it needs no journal.
    database.run("PRAGMA page_size = 16384; PRAGMA journal_mode = OFF");
    Transaction transaction(database);
    database.run(schema_sql);
    store_rows::add_study(database, manifest);
    database.run(fmt::format("PRAGMA user_version = {}", schema_version));
    transaction.commit();
  }
  fs::rename(part.path(), path);
  part.keep();
}

}  // namespace gyrostat::store_file
