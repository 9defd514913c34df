#include <gyrostat/results/store.hpp>

#include <algorithm>
#include <cerrno>
#include <map>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/results/schema.hpp>
#include <gyrostat/results/store_log.hpp>
#include <gyrostat/results/store_rows.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;
using sqlite::Access;
using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;
using namespace store_rows;

constexpr std::int64_t schema_version = 2;

/// One line for what SQLite says: what happened, and what to do.
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

/// Gives a store and its log a name that is free.
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

/// What would be lost without a word.
void require_sound_log(const fs::path& path) {
  if (const auto at = damage_of_log(path))
    throw StoreError(
        fmt::format("{}-wal: is damaged at byte {}, and the trials written after it are lost; "
                    "gyrostat repair {} "
                    "keeps those before, and gyrostat run makes the others again",
                    path.string(), *at, path.parent_path().string()));
}

/// Puts a whole store where there is none.
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
    add_study(database, manifest);
    database.run(fmt::format("PRAGMA user_version = {}", schema_version));
    transaction.commit();
  }
  fs::rename(part.path(), path);
  part.keep();
}

constexpr std::uint64_t all_trials = std::uint64_t{1} << 32;

/// The sessions of a store that may be damaged, each with its place in the other one.
std::map<std::int64_t, std::int64_t> salvaged_sessions(Database& damaged, Database& sound) {
  std::map<std::int64_t, std::int64_t> ids;
  constexpr std::int64_t most = 1'000'000;  // a number may be what is damaged
  const auto last = std::min(most, damaged.number("SELECT max(id) FROM session"));
  for (std::int64_t id = 1; id <= last; ++id) try {
      if (const auto session = session_of(damaged, id)) ids[id] = same_session(sound, *session);
    } catch (const sqlite::Error& error) {
      if (!error.is_damage()) throw;
    }
  return ids;
}

/// Takes over every trial that can be found by its number and holds what it was written with.
/// Asking for each leaves a damaged page as soon as it is met, where a scan would end.
void salvage(Database& damaged, Database& sound, const Manifest& manifest,
             Store::Repaired& result) {
  const auto sessions = salvaged_sessions(damaged, sound);
  RowInserter inserter(sound);
  std::int64_t finished = 0;
  for (std::uint32_t c = 0; c < manifest.cells.size(); ++c) {
    for (std::uint32_t t = 0; t < manifest.cells[c].trials; ++t) try {
        const auto row = salvaged_row(damaged, id_of(c, t));
        if (!row) continue;
        if (!sessions.contains(row->session)) throw damage(damaged, "a trial has no session");
        inserter.insert(row->id, sessions.at(row->session), row->calibrated, row->outcomes,
                        row->failures);
        ++result.kept;
      } catch (const sqlite::Error& error) {
        if (!error.is_damage() || error.path() != damaged.path()) throw;
        ++result.dropped;
      }
    finished += std::min(manifest.cells[c].finished, manifest.cells[c].trials);
  }
  // Rows that are on no page that can be reached are missing, too.
  result.dropped = std::max<std::int64_t>(result.dropped, finished - result.kept);
}

}  // namespace

Store::Lock::Lock(const fs::path& folder) {
  const auto path = folder / "store.lock";
  file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0)
    throw StoreError(fmt::format("{}: cannot be written to: {}", folder.string(),
                                 std::generic_category().message(errno)));
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    ::close(file);
    throw StoreError(
        fmt::format("{}: another run is writing here; wait for it, or name another folder "
                    "with --out",
                    folder.string()));
  }
}

Store::Lock::~Lock() {
  if (file >= 0) ::close(file);
}

/// Runs `work`, whose complaints then say what to do.
template <class Work>
auto Store::guarded(const Work& work) const {
  try {
    require_still_there();
    return work();
  } catch (const sqlite::Error& error) {
    throw explained(error);
  }
}

Store::Store(const fs::path& folder, Access access) : path_(folder / file_name) {
  if (access == Access::read && !fs::exists(path_))
    throw InputError(folder.string(),
                     fmt::format("holds no outcomes: there is no {}; allowed: the folder "
                                 "of a run, as runs/STUDY",
                                 file_name));
  require_sound_log(path_);
  try {
    database_ = std::make_unique<Database>(path_, access);
  } catch (const sqlite::Error& error) {
    throw explained(error);
  }
  struct stat at {};
  if (::stat(path_.c_str(), &at) == 0) device_ = at.st_dev, file_ = at.st_ino;
}

void Store::require_still_there() const {
  struct stat at {};
  if (::stat(path_.c_str(), &at) != 0 || at.st_dev != device_ || at.st_ino != file_)
    throw StoreError(path_.string() +
                     ": was removed or replaced while it was in use; what it held is lost, and the "
                     "same command begins anew");
}

Store Store::open(const fs::path& folder) {
  Store store(folder, Access::read);
  store.guarded([&] {
    require_version(*store.database_);
    (void)manifest_of(*store.database_);
    (void)sessions_of(*store.database_);
  });
  return store;
}

Store Store::open_or_create(const fs::path& folder, const Manifest& manifest) {
  Lock lock(folder);
  const auto path = folder / file_name;
  try {
    if (!fs::exists(path)) create(path, manifest);
  } catch (const sqlite::Error& error) {
    throw explained(error);
  }
  Store store(folder, Access::write);
  store.lock_.emplace(std::move(lock));
  store.guarded([&] {
    auto& database = *store.database_;
    // NORMAL: a power cut may take the last batches, whose trials are then simply missing.
    database.run(
        "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 256");
    require_version(database);
    const auto checked = database.text("PRAGMA quick_check(1)");
    if (checked != "ok") throw damage(database, checked);
    (void)manifest_of(database);
    (void)sessions_of(database);
  });
  return store;
}

std::optional<fs::path> Store::set_aside(const fs::path& folder) {
  if (!fs::exists(folder / file_name)) return std::nullopt;
  const Lock lock(folder);
  return renamed(folder / file_name);
}

Manifest Store::manifest() const {
  return guarded([&] { return manifest_of(*database_); });
}

std::vector<Session> Store::sessions() const {
  return guarded([&] { return sessions_of(*database_); });
}

void Store::set_source(std::string_view json) {
  guarded([&] {
    Transaction transaction(*database_);
    Statement(*database_, "UPDATE study SET source = ?").with(json).run();
    seal_manifest(*database_);
    transaction.commit();
  });
}

void Store::set_cells(std::span<const StoredCell> cells) {
  guarded([&] {
    Transaction transaction(*database_);
    store_rows::set_cells(*database_, cells);
    transaction.commit();
  });
}

void Store::begin_session(const Session& session) {
  guarded([&] { session_ = add_session(*database_, session); });
}

void Store::note_progress(std::string_view json) {
  guarded([&] {
    Statement(*database_, "UPDATE session SET progress = ? WHERE id = ?")
        .with(json, session_)
        .run();
  });
}

void Store::write(std::span<const TrialRow> rows) {
  guarded([&] {
    Transaction transaction(*database_);
    RowInserter inserter(*database_);
    for (const auto& row : rows)
      inserter.insert(id_of(row.cell, row.trial), session_, row.calibrated, row.outcomes,
                      row.failures);
    transaction.commit();
  });
}

std::size_t Store::merge(const fs::path& folder) {
  const Store other = open(folder);
  return guarded([&] {
    const auto count = [&] { return database_->number("SELECT sum(finished) FROM cell"); };
    other.database_->run("BEGIN");  // one state of it, should it still grow
    Transaction transaction(*database_);
    const auto before = count();
    std::vector<std::int64_t> session_ids;
    for (const auto& session : sessions_of(*other.database_))
      session_ids.push_back(same_session(*database_, session));
    RowInserter inserter(*database_);
    const auto cells = static_cast<std::uint32_t>(manifest_of(*other.database_).cells.size());
    for (std::uint32_t c = 0; c < cells; ++c)
      for_each_row_of(*other.database_, c, all_trials, [&](const Row& row) {
        const auto at = static_cast<std::size_t>(row.session - 1);
        if (at >= session_ids.size()) throw damage(*other.database_, "a trial has no session");
        inserter.insert(row.id, session_ids[at], row.calibrated, row.outcomes, row.failures);
      });
    transaction.commit();
    return static_cast<std::size_t>(count() - before);
  });
}

void Store::for_each_trial(std::uint32_t cell, std::uint32_t limit,
                           const std::function<void(const TrialView&)>& visit) const {
  guarded([&] {
    for_each_row_of(*database_, cell, limit, [&](const Row& row) {
      visit({trial_of(row.id), row.calibrated, row.outcomes});
    });
  });
}

void Store::for_each_failure(const std::function<void(const Failure&)>& visit) const {
  guarded([&] {
    database_->run("SAVEPOINT failures");
    std::int64_t count = 0;
    {
      Statement trials(*database_, "SELECT DISTINCT id FROM failure ORDER BY id");
      while (trials.step())
        for_each_row(*database_, trials.integer(0), trials.integer(0) + 1, [&](const Row& row) {
          for (const auto& failure : row.failures) ++count, visit(failure);
        });
    }
    const auto kept = database_->number("SELECT sum(failures) FROM cell");
    database_->run("RELEASE failures");
    if (count != kept)
      throw damage(*database_, fmt::format("{} failures are there, and {} were kept", count, kept));
  });
}

std::uint32_t Store::failed_trials(std::uint32_t cell, std::uint32_t limit) const {
  return guarded([&] {
    Statement row(*database_, "SELECT count(DISTINCT id) FROM failure WHERE id >= ? AND id < ?");
    row.with(id_of(cell, 0), id_of(cell, limit));
    return row.step() ? static_cast<std::uint32_t>(row.integer(0)) : 0U;
  });
}

Store::Repaired Store::repair(const fs::path& folder, const std::optional<Manifest>& named) {
  const auto path = folder / file_name;
  if (!fs::exists(path))
    throw InputError(folder.string(), fmt::format("there is no {} to be repaired", file_name));
  const Lock lock(folder);
  Repaired result;
  TemporaryPath part(path.string() + ".tmp");
  try {
    result.log_was_damaged = damage_of_log(path).has_value();
    Database damaged(path, Access::read);
    require_version(damaged);
    const auto manifest = named ? *named : manifest_of(damaged);
    create(part.path(), manifest);
    Database sound(part.path(), Access::write);
    sound.run("PRAGMA journal_mode = OFF; PRAGMA synchronous = FULL");
    Transaction transaction(sound);
    store_rows::set_cells(sound, manifest.cells);
    salvage(damaged, sound, manifest, result);
    transaction.commit();
  } catch (const sqlite::Error& error) {
    throw explained(error);
  }
  if (result.is_sound()) return result;
  const auto whole = part.path();
  part.keep();  // whole, and for a moment the only one by its name
  result.aside = renamed(path);
  fs::rename(whole, path);
  return result;
}

}  // namespace gyrostat
