#include <gyrostat/experiments/run/study_store.hpp>

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/run/build.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

constexpr const char* ways_out =
    "--mix goes on in it, --set-aside keeps it under another name and begins anew, --out names "
    "another folder";

void require_same_cells(const std::string& place, const std::vector<StoredCell>& there,
                        const std::vector<StoredCell>& wanted) {
  for (std::size_t c = 0; c < std::min(there.size(), wanted.size()); ++c)
    if (there[c].name != wanted[c].name || there[c].methods != wanted[c].methods)
      throw InputError(place,
                       fmt::format("cell {} there is '{}' with {}, not '{}' with {}; --set-aside "
                                   "keeps it under another name, --out names another folder",
                                   c + 1, there[c].name, fmt::join(there[c].methods, ", "),
                                   wanted[c].name, fmt::join(wanted[c].methods, ", ")));
}

void require_same_columns(const std::string& place, const Manifest& there, const Manifest& wanted) {
  if (there.columns != wanted.columns)
    throw InputError(place,
                     "its outcomes are of other metrics; --set-aside keeps it under another name");
}

std::string described(const Build& build) {
  return fmt::format("{} ({}, {})", build.version, build.compiler, build.flags);
}

void require_build(const std::string& place, const std::vector<Session>& sessions,
                   const Build& build) {
  for (const auto& session : sessions)
    if (session.trials > 0 && session.build != build)
      throw InputError(place, fmt::format("holds outcomes of build {}, not {}; {}",
                                          described(session.build), described(build), ways_out));
}

/// Throws InputError where outcomes of `study` by `build` may not be added to `store`.
void require_match(const Store& store, const Manifest& wanted, const Build& build,
                   const std::string& place, Mismatch mismatch) {
  const auto there = store.manifest();
  if (mismatch == Mismatch::refuse) {
    if (there.digest != wanted.digest)
      throw InputError(place,
                       fmt::format("holds outcomes of another study, or of '{}' before it was "
                                   "changed (digest {}, now {}); {}",
                                   there.name, there.digest, wanted.digest, ways_out));
    for (const auto& session : store.sessions())
      if (session.trials > 0 && session.digest != wanted.digest)
        throw InputError(place,
                         fmt::format("holds outcomes of another study among its own, mixed or "
                                     "merged in (digest {}, not {}); {}",
                                     session.digest, wanted.digest, ways_out));
    require_build(place, store.sessions(), build);
  }
  require_same_columns(place, there, wanted);
  require_same_cells(place, there.cells, wanted.cells);
}

/// Throws InputError where the store was filled with plug-ins that are not there now.
void require_plugins(const Store& store, const std::string& place) {
  std::set<std::string> lacking;
  for (const auto& session : store.sessions())
    for (const auto& name : plugins_of(session.build))
      if (!filter_types().find(name) && !effect_types().find(name)) lacking.insert(name);
  if (!lacking.empty())
    throw InputError(place,
                     fmt::format("it was run with plug-ins that are not there: {}; name them "
                                 "by --plugin or --filter-command",
                                 fmt::join(lacking, ", ")));
}

}  // namespace

std::vector<std::string> outcome_columns() {
  auto columns = metric_types().ids();
  for (const auto name : status_names) columns.emplace_back(name);
  columns.emplace_back("diverged");
  return columns;
}

Manifest manifest_of(const Study& study) {
  const auto folder = fs::absolute(study.path).parent_path().lexically_normal();
  Manifest manifest{study.digest,    study.name(),      study.seed, study.source,
                    folder.string(), outcome_columns(), {}};
  for (const auto& cell : study.cells) {
    auto& stored = manifest.cells.emplace_back(StoredCell{cell.name, {}, cell.trials, 0});
    for (const auto& method : cell.methods) stored.methods.push_back(method.id);
  }
  return manifest;
}

Store open_study_store(const fs::path& folder, const Study& study, Mismatch mismatch) {
  const auto place = (folder / Store::file_name).string();
  const auto manifest = manifest_of(study);
  if (mismatch == Mismatch::set_aside) Store::set_aside(folder);
  Store store = Store::open_or_create(folder, manifest);
  const auto build = build_for(study);
  require_match(store, manifest, build, place, mismatch);
  if (store.manifest().digest == manifest.digest) store.set_source(manifest.source);
  store.set_cells(manifest.cells);
  store.begin_session({study.digest, build, this_machine(), ::getpid(), utc_now(), "", 0});
  return store;
}

void require_same(const fs::path& into, const fs::path& from, Mismatch mismatch) {
  const Store a = Store::open(into), b = Store::open(from);
  const auto there = a.manifest(), other = b.manifest();
  const auto place = (from / Store::file_name).string();
  if (mismatch == Mismatch::refuse) {
    if (there.digest != other.digest)
      throw InputError(place,
                       fmt::format("is of another study than {} (digest {} and {}); --mix merges "
                                   "them all the same",
                                   into.string(), other.digest, there.digest));
    for (const auto& session : a.sessions())
      for (const auto& theirs : b.sessions())
        if (session.trials > 0 && theirs.trials > 0 && session.build != theirs.build)
          throw InputError(
              place, fmt::format("is by build {}, {} by {}; --mix merges them all the same",
                                 described(theirs.build), into.string(), described(session.build)));
  }
  require_same_columns(place, there, other);
  require_same_cells(place, there.cells, other.cells);
}

Study stored_study(const Store& store) {
  const auto manifest = store.manifest();
  const auto path = (fs::path(manifest.folder) / (manifest.name + ".json")).string();
  require_plugins(store, path);
  auto study = parse_study(Json::parse(manifest.source), path);
  for (std::size_t c = 0; c < std::min(study.cells.size(), manifest.cells.size()); ++c)
    study.cells[c].trials = manifest.cells[c].trials;
  return study;
}

TrialRow row_of(std::uint32_t cell, std::uint32_t trial, const Record& record) {
  TrialRow row{cell, trial, record.calibration_converged, record.numbers, {}};
  for (std::uint32_t m = 0; m < record.thrown.size(); ++m) {
    const Outcome outcome = record.of(m);
    if (!record.thrown[m].empty())
      row.failures.push_back({cell, trial, m, "threw: " + record.thrown[m]});
    if (!outcome.broke_down()) continue;
    std::string reason;
    for (std::size_t s = 0; s < status_names.size(); ++s)
      if (const auto status = static_cast<Status>(s);
          is_breakdown(status) && outcome.steps(status) > 0)
        reason += fmt::format("{}{} {:.0f} steps", reason.empty() ? "" : ", ", status_names[s],
                              outcome.steps(status));
    row.failures.push_back({cell, trial, m, reason});
  }
  return row;
}

}  // namespace gyrostat
