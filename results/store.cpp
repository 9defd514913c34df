#include <gyrostat/results/store.hpp>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/results/schema.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;
using sqlite::Access;
using sqlite::Database;
using sqlite::Statement;
using Texts = std::vector<std::string>;

constexpr std::int64_t schema_version = 1;
static_assert(std::endian::native == std::endian::little,
              "outcomes are kept as they lie in memory");

constexpr std::int64_t id_of(std::uint32_t cell, std::uint32_t trial) {
  return static_cast<std::int64_t>(cell) << 32 | trial;
}
constexpr std::uint32_t cell_of(std::int64_t id) { return static_cast<std::uint32_t>(id >> 32); }
constexpr std::uint32_t trial_of(std::int64_t id) { return static_cast<std::uint32_t>(id); }

/// Multiply-xor over 64-bit words, four at a time: finds what a disk or a stray write does, not
/// what a forger does.
std::int64_t checksum_of(std::int64_t id, bool calibrated, std::span<const double> outcomes) {
  std::uint64_t lanes[4] = {0x9e3779b97f4a7c15, 0xbf58476d1ce4e5b9, 0x94d049bb133111eb,
                            0x2545f4914f6cdd1d};
  const auto mix = [](std::uint64_t hash, std::uint64_t word) {
    hash = (hash ^ word) * 0xff51afd7ed558ccd;
    return hash ^ hash >> 32;
  };
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    lanes[i % 4] = mix(lanes[i % 4], std::bit_cast<std::uint64_t>(outcomes[i]));
  std::uint64_t hash = mix(static_cast<std::uint64_t>(id), calibrated);
  for (const auto lane : lanes) hash = mix(hash, lane);
  return static_cast<std::int64_t>(hash);
}

/// One line for what SQLite says: what happened, and what to do.
StoreError explained(const fs::path& path, const sqlite::Error& error) {
  auto reason = std::string(error.what()).substr(path.string().size() + 2);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  const auto said = [&](const char* what, const char* advice) {
    return StoreError(fmt::format("{}: {} ({}); {}", path.string(), what, reason, advice));
  };
  constexpr const char* again = "finished trials are kept, and the same command goes on from them";
  if (error.is_damage())
    return said("is damaged", "--set-aside keeps it under another name and begins anew");
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

sqlite::Error damage(const Database& database, const std::string& what) {
  return {SQLITE_CORRUPT, database.path().string() + ": " + what};
}

Texts texts(const Database& database, const std::string& json) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  if (!parsed.is_array()) throw damage(database, "a list of names cannot be read");
  return parsed.get<Texts>();
}

/// Made, and ended before anything was in it.
bool is_empty(Database& database) {
  return database.number("SELECT count(*) FROM sqlite_master") == 0;
}

std::vector<Session> sessions_of(Database& database) {
  std::vector<Session> sessions;
  Statement rows(database,
                 "SELECT digest, version, compiler, flags, machine, process, started, "
                 "progress, trials FROM session ORDER BY id");
  while (rows.step())
    sessions.push_back({rows.text(0),
                        {rows.text(1), rows.text(2), rows.text(3)},
                        rows.text(4),
                        rows.integer(5),
                        rows.text(6),
                        rows.text(7),
                        rows.integer(8)});
  return sessions;
}

std::int64_t add_session(Database& database, const Session& s) {
  Statement row(database,
                "INSERT INTO session (digest, version, compiler, flags, machine, process, "
                "started, progress) VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  row.with(s.digest, s.build.version, s.build.compiler, s.build.flags, s.machine, s.process,
           s.started, s.progress.empty() ? std::string("{}") : s.progress)
      .run();
  return sqlite3_last_insert_rowid(database.get());
}

/// The same session in `database`, added where it is not there.
std::int64_t same_session(Database& database, const Session& s) {
  Statement row(database,
                "SELECT id FROM session WHERE digest = ? AND version = ? AND compiler = ? AND "
                "flags = ? AND machine = ? AND process = ? AND started = ?");
  row.with(s.digest, s.build.version, s.build.compiler, s.build.flags, s.machine, s.process,
           s.started);
  return row.step() ? row.integer(0) : add_session(database, s);
}

struct RawTrial {
  std::int64_t id, session;
  Store::TrialView view;
};

/// Every trial with an id in [from, to), its checksum verified.
void for_each_row(Database& database, std::int64_t from, std::int64_t to,
                  const std::function<void(const RawTrial&)>& visit) {
  Statement rows(database,
                 "SELECT id, session, calibrated, outcomes, checksum FROM trial "
                 "WHERE id >= ? AND id < ? ORDER BY id");
  rows.with(from, to);
  std::vector<double> outcomes;
  while (rows.step()) {
    const auto id = rows.integer(0);
    const bool calibrated = rows.integer(2) != 0;
    const auto bytes = rows.blob(3);
    outcomes.resize(bytes.size() / sizeof(double));
    if (!bytes.empty())
      std::memcpy(outcomes.data(), bytes.data(), outcomes.size() * sizeof(double));
    if (checksum_of(id, calibrated, outcomes) != rows.integer(4))
      throw damage(database, fmt::format("trial {} of cell {} fails its checksum", trial_of(id),
                                         cell_of(id) + 1));
    visit({id, rows.integer(1), {trial_of(id), calibrated, outcomes}});
  }
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
    return work();
  } catch (const sqlite::Error& error) {
    throw explained(path_, error);
  }
}

Store::Store(const fs::path& folder, Access access) : path_(folder / file_name) {
  if (access == Access::read && !fs::exists(path_))
    throw InputError(folder.string(),
                     fmt::format("holds no outcomes: there is no {}; allowed: the folder "
                                 "of a run, as runs/STUDY",
                                 file_name));
  if (access == Access::write) lock_.emplace(folder);
  guarded([&] { database_ = std::make_unique<Database>(path_, access); });
}

Store Store::open(const fs::path& folder) {
  Store store(folder, Access::read);
  store.guarded([&] {
    const auto version = store.database_->number("PRAGMA user_version");
    if (version == 0 && is_empty(*store.database_))
      throw StoreError(store.path_.string() + ": holds no outcomes yet");
    if (version != schema_version)
      throw StoreError(store.path_.string() + ": is not a store of this version of gyrostat");
  });
  return store;
}

Store Store::open_or_create(const fs::path& folder, const Manifest& manifest) {
  Store store(folder, Access::write);
  store.guarded([&] {
    auto& database = *store.database_;
    // Rows of some KiB fill large pages better. NORMAL: a power cut may take the last batches,
    // whose trials are then simply missing.
    database.run(
        "PRAGMA page_size = 16384; PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; "
        "PRAGMA wal_autocheckpoint = 256");
    const auto version = database.number("PRAGMA user_version");
    if (version == 0 && is_empty(database))
      store.create(manifest);
    else if (version != schema_version)
      throw StoreError(store.path_.string() +
                       ": is not a store of this version of gyrostat; "
                       "--set-aside keeps it under another name");
    const auto checked = database.text("PRAGMA quick_check(1)");
    if (checked != "ok") throw damage(database, checked);
  });
  return store;
}

void Store::create(const Manifest& m) {
  sqlite::Transaction transaction(*database_);
  database_->run(schema_sql);
  Statement(*database_,
            "INSERT INTO study (digest, name, seed, source, folder, columns) "
            "VALUES (?, ?, ?, ?, ?, ?)")
      .with(m.digest, m.name, static_cast<std::int64_t>(m.seed), m.source, m.folder,
            nlohmann::json(m.columns).dump())
      .run();
  database_->run(fmt::format("PRAGMA user_version = {}", schema_version));
  transaction.commit();
}

std::optional<fs::path> Store::set_aside(const fs::path& folder) {
  const auto path = folder / file_name;
  if (!fs::exists(path)) return std::nullopt;
  const Lock lock(folder);
  int number = 1;
  fs::path aside;
  do aside = folder / fmt::format("store-{}.db", number++);
  while (fs::exists(aside));
  // The log goes first: without its database it is nothing, the database without it is older.
  const auto log = fs::path(path.string() + "-wal");
  if (fs::exists(log)) fs::rename(log, aside.string() + "-wal");
  fs::remove(path.string() + "-shm");
  fs::rename(path, aside);
  return aside;
}

Manifest Store::manifest() const {
  return guarded([&] {
    Manifest m;
    Statement row(*database_, "SELECT digest, name, seed, source, folder, columns FROM study");
    if (!row.step()) throw damage(*database_, "the study is not named");
    m = {row.text(0), row.text(1), static_cast<std::uint64_t>(row.integer(2)),
         row.text(3), row.text(4), texts(*database_, row.text(5)),
         {}};
    Statement cells(*database_, "SELECT name, methods, trials, finished FROM cell ORDER BY id");
    while (cells.step())
      m.cells.push_back({cells.text(0), texts(*database_, cells.text(1)),
                         static_cast<std::uint32_t>(cells.integer(2)),
                         static_cast<std::uint32_t>(cells.integer(3))});
    return m;
  });
}

std::vector<Session> Store::sessions() const {
  return guarded([&] { return sessions_of(*database_); });
}

void Store::set_source(std::string_view json) {
  guarded([&] { Statement(*database_, "UPDATE study SET source = ?").with(json).run(); });
}

void Store::set_cells(std::span<const StoredCell> cells) {
  guarded([&] {
    sqlite::Transaction transaction(*database_);
    Statement row(*database_,
                  "INSERT INTO cell (id, name, methods, trials) VALUES (?, ?, ?, ?) "
                  "ON CONFLICT (id) DO UPDATE SET trials = excluded.trials");
    for (std::size_t c = 0; c < cells.size(); ++c)
      row.with(static_cast<std::int64_t>(c), cells[c].name, nlohmann::json(cells[c].methods).dump(),
               static_cast<std::int64_t>(cells[c].trials))
          .run();
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

void Store::insert(Statement& statement, std::int64_t id, std::int64_t session, bool calibrated,
                   std::span<const double> outcomes) {
  const auto checksum = checksum_of(id, calibrated, outcomes);
  statement.with(id, session, std::int64_t{calibrated}, std::as_bytes(outcomes), checksum).run();
  if (sqlite3_changes(database_->get()) > 0) return;
  Statement known(*database_, "SELECT checksum, outcomes FROM trial WHERE id = ?");
  known.with(id);
  const auto bytes = std::as_bytes(outcomes);
  if (!known.step() || known.integer(0) != checksum || known.blob(1).size() != bytes.size() ||
      std::memcmp(known.blob(1).data(), bytes.data(), bytes.size()) != 0)
    throw StoreError(
        fmt::format("{}: trial {} of cell {} is there with another outcome; were the two "
                    "made by the same build?",
                    path_.string(), trial_of(id), cell_of(id) + 1));
}

void Store::insert(Statement& statement, const Failure& failure) {
  statement.with(id_of(failure.cell, failure.trial), std::int64_t{failure.method}, failure.reason)
      .run();
}

constexpr std::string_view insert_trial =
    "INSERT INTO trial (id, session, calibrated, outcomes, checksum) VALUES (?, ?, ?, ?, ?) "
    "ON CONFLICT (id) DO NOTHING";
constexpr std::string_view insert_failure =
    "INSERT INTO failure (id, method, reason) VALUES (?, ?, ?) ON CONFLICT DO NOTHING";

void Store::write(std::span<const TrialRow> rows) {
  guarded([&] {
    sqlite::Transaction transaction(*database_);
    Statement trial(*database_, insert_trial), failed(*database_, insert_failure);
    for (const auto& row : rows) {
      insert(trial, id_of(row.cell, row.trial), session_, row.calibrated, row.outcomes);
      for (const auto& failure : row.failures) insert(failed, failure);
    }
    transaction.commit();
  });
}

std::size_t Store::merge(const fs::path& folder) {
  const Store other = open(folder);
  const auto count = [&] { return database_->number("SELECT sum(finished) FROM cell"); };
  const auto theirs = other.guarded([&] {
    other.database_->run("BEGIN");  // one state of it, should it still grow
    return sessions_of(*other.database_);
  });
  return guarded([&] {
    sqlite::Transaction transaction(*database_);
    const auto before = count();
    std::vector<std::int64_t> session_ids;
    for (const auto& session : theirs) session_ids.push_back(same_session(*database_, session));
    Statement trial(*database_, insert_trial), failed(*database_, insert_failure);
    for_each_row(*other.database_, 0, std::numeric_limits<std::int64_t>::max(),
                 [&](const RawTrial& row) {
                   const auto at = static_cast<std::size_t>(row.session - 1);
                   if (at >= session_ids.size())
                     throw damage(*other.database_, "a trial has no session");
                   insert(trial, row.id, session_ids[at], row.view.calibrated, row.view.outcomes);
                 });
    other.for_each_failure([&](const Failure& failure) { insert(failed, failure); });
    transaction.commit();
    return static_cast<std::size_t>(count() - before);
  });
}

void Store::for_each_trial(std::uint32_t cell, std::uint32_t limit,
                           const std::function<void(const TrialView&)>& visit) const {
  guarded([&] {
    for_each_row(*database_, id_of(cell, 0), id_of(cell, 0) + limit,
                 [&](const RawTrial& row) { visit(row.view); });
  });
}

void Store::for_each_failure(const std::function<void(const Failure&)>& visit) const {
  guarded([&] {
    Statement rows(*database_, "SELECT id, method, reason FROM failure ORDER BY id, method");
    while (rows.step())
      visit({cell_of(rows.integer(0)), trial_of(rows.integer(0)),
             static_cast<std::uint32_t>(rows.integer(1)), rows.text(2)});
  });
}

std::uint32_t Store::failed_trials(std::uint32_t cell, std::uint32_t limit) const {
  return guarded([&] {
    Statement row(*database_, "SELECT count(DISTINCT id) FROM failure WHERE id >= ? AND id < ?");
    row.with(id_of(cell, 0), id_of(cell, 0) + limit);
    return row.step() ? static_cast<std::uint32_t>(row.integer(0)) : 0U;
  });
}

}  // namespace gyrostat
