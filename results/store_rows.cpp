#include <gyrostat/results/store_rows.hpp>

#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>

namespace gyrostat::store_rows {
namespace {

using sqlite::Database;
using sqlite::Statement;
using Texts = std::vector<std::string>;

static_assert(std::endian::native == std::endian::little,
              "outcomes are kept as they lie in memory");

/// Multiply-xor over 64-bit words: finds what a disk or a stray write does, not what a forger does.
class Checksum {
 public:
  Checksum& word(std::uint64_t word) {
    hash_ = mix(hash_, word);
    return *this;
  }
  Checksum& text(std::string_view text) {
    word(text.size());
    for (std::size_t i = 0; i < text.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t next = 0;
      std::memcpy(&next, text.data() + i, std::min(sizeof next, text.size() - i));
      word(next);
    }
    return *this;
  }
  /// Four at a time, since these are most of a store.
  Checksum& numbers(std::span<const double> values) {
    std::uint64_t lanes[4] = {0x9e3779b97f4a7c15, 0xbf58476d1ce4e5b9, 0x94d049bb133111eb,
                              0x2545f4914f6cdd1d};
    for (std::size_t i = 0; i < values.size(); ++i)
      lanes[i % 4] = mix(lanes[i % 4], std::bit_cast<std::uint64_t>(values[i]));
    for (const auto lane : lanes) word(lane);
    return *this;
  }
  std::int64_t value() const { return static_cast<std::int64_t>(hash_); }

 private:
  static std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
    hash = (hash ^ word) * 0xff51afd7ed558ccd;
    return hash ^ hash >> 32;
  }
  std::uint64_t hash_ = 0x2127599bf4325c37;
};

std::int64_t checksum_of(std::int64_t id, bool calibrated, std::span<const double> outcomes,
                         std::span<const Failure> failures) {
  Checksum sum;
  sum.word(static_cast<std::uint64_t>(id)).word(calibrated).numbers(outcomes);
  for (const auto& failure : failures) sum.word(failure.method).text(failure.reason);
  return sum.value();
}

std::int64_t checksum_of(const Session& s) {
  Checksum sum;
  for (const auto* text :
       {&s.digest, &s.build.version, &s.build.compiler, &s.build.flags, &s.machine, &s.started})
    sum.text(*text);
  return sum.word(static_cast<std::uint64_t>(s.process)).value();
}

Texts texts(const Database& database, const std::string& json) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  if (!parsed.is_array() ||
      !std::ranges::all_of(parsed, [](const auto& t) { return t.is_string(); }))
    throw damage(database, "a list of names cannot be read");
  return parsed.get<Texts>();
}

struct SealedManifest {
  Manifest manifest;
  std::int64_t stored = 0, actual = 0;
};

SealedManifest read_manifest(Database& database) {
  Manifest m;
  Checksum sum;
  Statement row(database,
                "SELECT digest, name, seed, source, folder, columns, checksum FROM study");
  if (!row.step()) throw damage(database, "the study is not named");
  m = {row.text(0), row.text(1), static_cast<std::uint64_t>(row.integer(2)),
       row.text(3), row.text(4), texts(database, row.text(5)),
       {}};
  for (const int column : {0, 1, 3, 4, 5}) sum.text(row.text(column));
  sum.word(m.seed);
  Statement cells(database, "SELECT id, name, methods, trials, finished FROM cell ORDER BY id");
  while (cells.step()) {
    m.cells.push_back({cells.text(1), texts(database, cells.text(2)),
                       static_cast<std::uint32_t>(cells.integer(3)),
                       static_cast<std::uint32_t>(cells.integer(4))});
    sum.word(static_cast<std::uint64_t>(cells.integer(0))).text(cells.text(1)).text(cells.text(2));
    sum.word(m.cells.back().trials);
  }
  return {std::move(m), row.integer(6), sum.value()};
}

/// Reads all within see one state of the store, whoever writes meanwhile.
class Snapshot {
 public:
  explicit Snapshot(Database& database) : database_(database) {
    database_.run("SAVEPOINT snapshot");
  }
  ~Snapshot() { sqlite3_exec(database_.get(), "RELEASE snapshot", nullptr, nullptr, nullptr); }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

 private:
  Database& database_;
};

std::int64_t counted(Database& database, const char* sql, std::int64_t from, std::int64_t to) {
  Statement count(database, sql);
  count.with(from, to);
  return count.step() ? count.integer(0) : 0;
}

/// Those of one trial after the other, in step with its rows.
class FailureRows {
 public:
  FailureRows(Database& database, std::int64_t from, std::int64_t to)
      : database_(database),
        rows_(database,
              "SELECT id, method, reason FROM failure WHERE id >= ? AND id < ? "
              "ORDER BY id, method") {
    rows_.with(from, to);
    has_row_ = rows_.step();
  }

  void take(std::int64_t id, std::vector<Failure>& into) {
    into.clear();
    for (; has_row_ && rows_.integer(0) <= id; has_row_ = rows_.step()) {
      if (rows_.integer(0) < id) orphan();
      into.push_back(
          {cell_of(id), trial_of(id), static_cast<std::uint32_t>(rows_.integer(1)), rows_.text(2)});
    }
  }
  void finish() const {
    if (has_row_) orphan();
  }

 private:
  [[noreturn]] void orphan() const {
    throw damage(database_, fmt::format("trial {} of cell {} has failures and no outcome",
                                        trial_of(rows_.integer(0)), cell_of(rows_.integer(0)) + 1));
  }
  Database& database_;
  Statement rows_;
  bool has_row_ = false;
};

}  // namespace

sqlite::Error damage(const Database& database, const std::string& what) {
  return {SQLITE_CORRUPT, database.path(), what};
}

Manifest manifest_of(Database& database) {
  const Snapshot snapshot(database);
  auto read = read_manifest(database);
  if (read.stored != read.actual)
    throw damage(database, "the names of the study, its cells or methods fail their checksum");
  return std::move(read.manifest);
}

void seal_manifest(Database& database) {
  Statement(database, "UPDATE study SET checksum = ?").with(read_manifest(database).actual).run();
}

void add_study(Database& database, const Manifest& m) {
  Statement(database,
            "INSERT INTO study (digest, name, seed, source, folder, columns, checksum) "
            "VALUES (?, ?, ?, ?, ?, ?, 0)")
      .with(m.digest, m.name, static_cast<std::int64_t>(m.seed), m.source, m.folder,
            nlohmann::json(m.columns).dump())
      .run();
  seal_manifest(database);
}

void set_cells(Database& database, std::span<const StoredCell> cells) {
  Statement row(database,
                "INSERT INTO cell (id, name, methods, trials) VALUES (?, ?, ?, ?) "
                "ON CONFLICT (id) DO UPDATE SET trials = excluded.trials");
  for (std::size_t c = 0; c < cells.size(); ++c)
    row.with(static_cast<std::int64_t>(c), cells[c].name, nlohmann::json(cells[c].methods).dump(),
             static_cast<std::int64_t>(cells[c].trials))
        .run();
  seal_manifest(database);
}

std::optional<Session> session_of(Database& database, std::int64_t id) {
  Statement row(database,
                "SELECT digest, version, compiler, flags, machine, process, started, "
                "progress, trials, checksum FROM session WHERE id = ?");
  row.with(id);
  if (!row.step()) return std::nullopt;
  Session session{row.text(0),   {row.text(1), row.text(2), row.text(3)},
                  row.text(4),   row.integer(5),
                  row.text(6),   row.text(7),
                  row.integer(8)};
  if (row.integer(9) != checksum_of(session))
    throw damage(database, fmt::format("session {} fails its checksum", id));
  return session;
}

std::vector<Session> sessions_of(Database& database) {
  const Snapshot snapshot(database);
  std::vector<Session> sessions;
  std::int64_t trials = 0;
  const auto last = database.number("SELECT max(id) FROM session");
  for (std::int64_t id = 1; id <= last; ++id) {
    const auto session = session_of(database, id);
    if (!session) throw damage(database, fmt::format("session {} is missing", id));
    trials += session->trials;
    sessions.push_back(*session);
  }
  if (trials != database.number("SELECT sum(finished) FROM cell"))
    throw damage(database, "its sessions have not made as many trials as its cells have");
  return sessions;
}

std::int64_t add_session(Database& database, const Session& s) {
  Statement row(database,
                "INSERT INTO session (digest, version, compiler, flags, machine, process, "
                "started, progress, checksum) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.with(s.digest, s.build.version, s.build.compiler, s.build.flags, s.machine, s.process,
           s.started, s.progress.empty() ? std::string("{}") : s.progress, checksum_of(s))
      .run();
  return sqlite3_last_insert_rowid(database.get());
}

std::int64_t same_session(Database& database, const Session& s) {
  Statement row(database,
                "SELECT id FROM session WHERE digest = ? AND version = ? AND compiler = ? AND "
                "flags = ? AND machine = ? AND process = ? AND started = ?");
  row.with(s.digest, s.build.version, s.build.compiler, s.build.flags, s.machine, s.process,
           s.started);
  return row.step() ? row.integer(0) : add_session(database, s);
}

namespace {

/// `take_failures` fills in those of the row; the checksum is of both.
void for_each_verified(Database& database, std::int64_t from, std::int64_t to,
                       const std::function<void(Row&)>& take_failures,
                       const std::function<void(const Row&)>& visit) {
  Statement rows(database,
                 "SELECT id, session, calibrated, outcomes, checksum FROM trial "
                 "WHERE id >= ? AND id < ? ORDER BY id");
  rows.with(from, to);
  Row row;
  while (rows.step()) {
    row.id = rows.integer(0);
    row.session = rows.integer(1);
    row.calibrated = rows.integer(2) != 0;
    const auto bytes = rows.blob(3);
    row.outcomes.resize(bytes.size() / sizeof(double));
    if (!bytes.empty())
      std::memcpy(row.outcomes.data(), bytes.data(), row.outcomes.size() * sizeof(double));
    take_failures(row);
    if (checksum_of(row.id, row.calibrated, row.outcomes, row.failures) != rows.integer(4))
      throw damage(database, fmt::format("trial {} of cell {} fails its checksum", trial_of(row.id),
                                         cell_of(row.id) + 1));
    visit(row);
  }
}

}  // namespace

void for_each_row(Database& database, std::int64_t from, std::int64_t to,
                  const std::function<void(const Row&)>& visit) {
  FailureRows failures(database, from, to);
  for_each_verified(
      database, from, to, [&](Row& row) { failures.take(row.id, row.failures); }, visit);
  failures.finish();
}

std::optional<Row> salvaged_row(Database& database, std::int64_t id) {
  std::optional<Row> found;
  const auto keep = [&](const Row& row) { found = row; };
  try {
    for_each_row(database, id, id + 1, keep);
  } catch (const sqlite::Error& error) {
    if (!error.is_damage()) throw;
    found.reset();
    for_each_verified(
        database, id, id + 1, [](Row& row) { row.failures.clear(); }, keep);
  }
  return found;
}

void for_each_row_of(Database& database, std::uint32_t cell, std::uint64_t limit,
                     const std::function<void(const Row&)>& visit) {
  const Snapshot snapshot(database);
  const auto from = id_of(cell, 0), to = id_of(cell, limit), end = id_of(cell + 1, 0);
  std::int64_t trials = 0, failures = 0;
  for_each_row(database, from, to, [&](const Row& row) {
    ++trials;
    failures += static_cast<std::int64_t>(row.failures.size());
    visit(row);
  });
  trials += counted(database, "SELECT count(*) FROM trial WHERE id >= ? AND id < ?", to, end);
  failures += counted(database, "SELECT count(*) FROM failure WHERE id >= ? AND id < ?", to, end);
  Statement kept(database, "SELECT finished, failures FROM cell WHERE id = ?");
  kept.with(std::int64_t{cell});
  const bool is_known = kept.step();
  const auto finished = is_known ? kept.integer(0) : 0;
  if (trials != finished)
    throw damage(database, fmt::format("{} trials of cell {} are there, and {} were finished",
                                       trials, cell + 1, finished));
  if (failures != (is_known ? kept.integer(1) : 0))
    throw damage(database, fmt::format("failures of cell {} are missing", cell + 1));
}

RowInserter::RowInserter(Database& database)
    : database_(database),
      trial_(database,
             "INSERT INTO trial (id, session, calibrated, outcomes, checksum) "
             "VALUES (?, ?, ?, ?, ?) ON CONFLICT (id) DO NOTHING"),
      failure_(database,
               "INSERT INTO failure (id, method, reason) VALUES (?, ?, ?) ON CONFLICT DO NOTHING") {
}

void RowInserter::insert(std::int64_t id, std::int64_t session, bool calibrated,
                         std::span<const double> outcomes, std::span<const Failure> failures) {
  const auto checksum = checksum_of(id, calibrated, outcomes, failures);
  trial_.with(id, session, std::int64_t{calibrated}, std::as_bytes(outcomes), checksum).run();
  if (sqlite3_changes(database_.get()) > 0) {
    for (const auto& failure : failures)
      failure_.with(id, std::int64_t{failure.method}, failure.reason).run();
    return;
  }
  Statement known(database_, "SELECT checksum, outcomes FROM trial WHERE id = ?");
  known.with(id);
  const auto bytes = std::as_bytes(outcomes);
  if (!known.step() || known.integer(0) != checksum || known.blob(1).size() != bytes.size() ||
      std::memcmp(known.blob(1).data(), bytes.data(), bytes.size()) != 0)
    throw StoreError(
        fmt::format("{}: trial {} of cell {} is there with another outcome; were the two "
                    "made by the same build?",
                    database_.path().string(), trial_of(id), cell_of(id) + 1));
}

}  // namespace gyrostat::store_rows
