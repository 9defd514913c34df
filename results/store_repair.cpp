#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/results/store_file.hpp>
#include <gyrostat/results/store_log.hpp>
#include <gyrostat/results/store_rows.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;
using sqlite::Access;
using sqlite::Database;
using sqlite::Transaction;

/// The sessions of a store that may be damaged, each with its place in the other one.
std::map<std::int64_t, std::int64_t> salvaged_sessions(Database& damaged, Database& sound) {
  std::map<std::int64_t, std::int64_t> ids;
  constexpr std::int64_t most = 1'000'000;  // a number may be what is damaged
  const auto last = std::min(most, damaged.number("SELECT max(id) FROM session"));
  for (std::int64_t id = 1; id <= last; ++id) try {
      if (const auto session = store_rows::session_of(damaged, id))
        ids[id] = store_rows::same_session(sound, *session);
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
  store_rows::RowInserter inserter(sound);
  std::int64_t finished = 0;
  for (std::uint32_t c = 0; c < manifest.cells.size(); ++c) {
    for (std::uint32_t t = 0; t < manifest.cells[c].trials; ++t) try {
        const auto row = store_rows::salvaged_row(damaged, store_rows::id_of(c, t));
        if (!row) continue;
        if (!sessions.contains(row->session))
          throw store_rows::damage(damaged, "a trial has no session");
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
    store_file::require_version(damaged);
    const auto manifest = named ? *named : store_rows::manifest_of(damaged);
    store_file::create(part.path(), manifest);
    Database sound(part.path(), Access::write);
    sound.run("PRAGMA journal_mode = OFF; PRAGMA synchronous = FULL");
    Transaction transaction(sound);
    store_rows::set_cells(sound, manifest.cells);
    salvage(damaged, sound, manifest, result);
    transaction.commit();
  } catch (const sqlite::Error& error) {
    throw store_file::explained(error);
  }
  if (result.is_sound()) return result;
  const auto whole = part.path();
  part.keep();  // whole, and for a moment the only one by its name
  result.aside = store_file::renamed(path);
  fs::rename(whole, path);
  return result;
}

}  // namespace gyrostat
