#include <gyrostat/results/store.hpp>

#include <fmt/format.h>
#include <sys/stat.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/results/store_file.hpp>
#include <gyrostat/results/store_rows.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t all_trials = std::uint64_t{1} << 32;

}  // namespace

/// Runs `work`, whose complaints then say what to do.
template <class Work>
auto Store::guarded(const Work& work) const {
  try {
    require_still_there();
    return work();
  } catch (const sqlite::Error& error) {
    throw store_file::explained(error);
  }
}

Store::Store(const fs::path& folder, sqlite::Access access) : path_(folder / file_name) {
  if (access == sqlite::Access::read && !fs::exists(path_))
    throw InputError(folder.string(),
                     fmt::format("holds no outcomes: there is no {}; allowed: the folder "
                                 "of a run, as runs/STUDY",
                                 file_name));
  store_file::require_sound_log(path_);
  try {
    database_ = std::make_unique<sqlite::Database>(path_, access);
  } catch (const sqlite::Error& error) {
    throw store_file::explained(error);
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
  Store store(folder, sqlite::Access::read);
  store.guarded([&] {
    store_file::require_version(*store.database_);
    (void)store_rows::manifest_of(*store.database_);
    (void)store_rows::sessions_of(*store.database_);
  });
  return store;
}

Store Store::open_or_create(const fs::path& folder, const Manifest& manifest) {
  Lock lock(folder);
  const auto path = folder / file_name;
  try {
    if (!fs::exists(path)) store_file::create(path, manifest);
  } catch (const sqlite::Error& error) {
    throw store_file::explained(error);
  }
  Store store(folder, sqlite::Access::write);
  store.lock_.emplace(std::move(lock));
  store.guarded([&] {
    auto& database = *store.database_;
    // NORMAL: a power cut may take the last batches, whose trials are then simply missing.
    database.run(
        "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 256");
    store_file::require_version(database);
    const auto checked = database.text("PRAGMA quick_check(1)");
    if (checked != "ok") throw store_rows::damage(database, checked);
    (void)store_rows::manifest_of(database);
    (void)store_rows::sessions_of(database);
  });
  return store;
}

std::optional<fs::path> Store::set_aside(const fs::path& folder) {
  if (!fs::exists(folder / file_name)) return std::nullopt;
  const Lock lock(folder);
  return store_file::renamed(folder / file_name);
}

Manifest Store::manifest() const {
  return guarded([&] { return store_rows::manifest_of(*database_); });
}

std::vector<Session> Store::sessions() const {
  return guarded([&] { return store_rows::sessions_of(*database_); });
}

void Store::set_source(std::string_view json) {
  guarded([&] {
    sqlite::Transaction transaction(*database_);
    sqlite::Statement(*database_, "UPDATE study SET source = ?").with(json).run();
    store_rows::seal_manifest(*database_);
    transaction.commit();
  });
}

void Store::set_cells(std::span<const StoredCell> cells) {
  guarded([&] {
    sqlite::Transaction transaction(*database_);
    store_rows::set_cells(*database_, cells);
    transaction.commit();
  });
}

void Store::begin_session(const Session& session) {
  guarded([&] { session_ = store_rows::add_session(*database_, session); });
}

void Store::note_progress(std::string_view json) {
  guarded([&] {
    sqlite::Statement(*database_, "UPDATE session SET progress = ? WHERE id = ?")
        .with(json, session_)
        .run();
  });
}

void Store::write(std::span<const TrialRow> rows) {
  guarded([&] {
    sqlite::Transaction transaction(*database_);
    store_rows::RowInserter inserter(*database_);
    for (const auto& row : rows)
      inserter.insert(store_rows::id_of(row.cell, row.trial), session_, row.calibrated,
                      row.outcomes, row.failures);
    transaction.commit();
  });
}

std::size_t Store::merge(const fs::path& folder) {
  const Store other = open(folder);
  return guarded([&] {
    const auto count = [&] { return database_->number("SELECT sum(finished) FROM cell"); };
    other.database_->run("BEGIN");  // one state of it, should it still grow
    sqlite::Transaction transaction(*database_);
    const auto before = count();
    std::vector<std::int64_t> session_ids;
    for (const auto& session : store_rows::sessions_of(*other.database_))
      session_ids.push_back(store_rows::same_session(*database_, session));
    store_rows::RowInserter inserter(*database_);
    const auto cells =
        static_cast<std::uint32_t>(store_rows::manifest_of(*other.database_).cells.size());
    for (std::uint32_t c = 0; c < cells; ++c)
      store_rows::for_each_row_of(*other.database_, c, all_trials, [&](const store_rows::Row& row) {
        const auto at = static_cast<std::size_t>(row.session - 1);
        if (at >= session_ids.size())
          throw store_rows::damage(*other.database_, "a trial has no session");
        inserter.insert(row.id, session_ids[at], row.calibrated, row.outcomes, row.failures);
      });
    transaction.commit();
    return static_cast<std::size_t>(count() - before);
  });
}

void Store::for_each_trial(std::uint32_t cell, std::uint32_t limit,
                           const std::function<void(const TrialView&)>& visit) const {
  guarded([&] {
    store_rows::for_each_row_of(*database_, cell, limit, [&](const store_rows::Row& row) {
      visit({store_rows::trial_of(row.id), row.calibrated, row.outcomes});
    });
  });
}

void Store::for_each_failure(const std::function<void(const Failure&)>& visit) const {
  guarded([&] {
    database_->run("SAVEPOINT failures");
    std::int64_t count = 0;
    {
      sqlite::Statement trials(*database_, "SELECT DISTINCT id FROM failure ORDER BY id");
      while (trials.step())
        store_rows::for_each_row(*database_, trials.integer(0), trials.integer(0) + 1,
                                 [&](const store_rows::Row& row) {
                                   for (const auto& failure : row.failures) ++count, visit(failure);
                                 });
    }
    const auto kept = database_->number("SELECT sum(failures) FROM cell");
    database_->run("RELEASE failures");
    if (count != kept)
      throw store_rows::damage(*database_,
                               fmt::format("{} failures are there, and {} were kept", count, kept));
  });
}

std::uint32_t Store::failed_trials(std::uint32_t cell, std::uint32_t limit) const {
  return guarded([&] {
    sqlite::Statement row(*database_,
                          "SELECT count(DISTINCT id) FROM failure WHERE id >= ? AND id < ?");
    row.with(store_rows::id_of(cell, 0), store_rows::id_of(cell, limit));
    return row.step() ? static_cast<std::uint32_t>(row.integer(0)) : 0U;
  });
}

}  // namespace gyrostat
