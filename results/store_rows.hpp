#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/results/sqlite.hpp>
#include <gyrostat/results/store.hpp>

/// The rows of a store's tables as they are read and written: every one verified where it is read.
/// SQLite keeps no checksums, so what a disk or a stray write changes is found here. Everything
/// throws sqlite::Error.
namespace gyrostat::store_rows {

constexpr std::int64_t id_of(std::uint32_t cell, std::uint64_t trial) {
  return (static_cast<std::int64_t>(cell) << 32) + static_cast<std::int64_t>(trial);
}
constexpr std::uint32_t cell_of(std::int64_t id) { return static_cast<std::uint32_t>(id >> 32); }
constexpr std::uint32_t trial_of(std::int64_t id) { return static_cast<std::uint32_t>(id); }

sqlite::Error damage(const sqlite::Database& database, const std::string& what);

/// The study and its cells; their names fail their checksum where they have changed unasked.
Manifest manifest_of(sqlite::Database& database);
/// Writes the checksum of the study's row and of all names of cells, as they are now.
void seal_manifest(sqlite::Database& database);
void add_study(sqlite::Database& database, const Manifest& manifest);
void set_cells(sqlite::Database& database, std::span<const StoredCell> cells);

std::vector<Session> sessions_of(sqlite::Database& database);
/// One of them; nothing where there is none of that number.
std::optional<Session> session_of(sqlite::Database& database, std::int64_t id);
std::int64_t add_session(sqlite::Database& database, const Session& session);
/// The same session in `database`, added where it is not there.
std::int64_t same_session(sqlite::Database& database, const Session& session);

struct Row {
  std::int64_t id = 0, session = 0;
  bool calibrated = true;
  std::vector<double> outcomes;
  std::vector<Failure> failures;
};

/// A trial, if it is there and holds what it was written with; also one without failures whose
/// place among the failures cannot be read.
std::optional<Row> salvaged_row(sqlite::Database& database, std::int64_t id);
/// Every trial with an id in [from, to), in order.
void for_each_row(sqlite::Database& database, std::int64_t from, std::int64_t to,
                  const std::function<void(const Row&)>& visit);
/// The trials of a cell below `limit`, in order, of one state of the store; as many as it counts.
void for_each_row_of(sqlite::Database& database, std::uint32_t cell, std::uint64_t limit,
                     const std::function<void(const Row&)>& visit);

/// Adds rows; one that is there already must be the same, to the bit, or StoreError is thrown.
class RowInserter {
 public:
  explicit RowInserter(sqlite::Database& database);
  void insert(std::int64_t id, std::int64_t session, bool calibrated,
              std::span<const double> outcomes, std::span<const Failure> failures);

 private:
  sqlite::Database& database_;
  sqlite::Statement trial_, failure_;
};

}  // namespace gyrostat::store_rows
