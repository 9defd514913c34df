#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/results/sqlite.hpp>

namespace gyrostat {

/// A store cannot be used or went wrong: one line that says what happened and what to do.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A cell as the store knows it: the names by which its outcomes are called.
struct StoredCell {
  std::string name;
  std::vector<std::string> methods;
  std::uint32_t trials = 0;    ///< asked for last
  std::uint32_t finished = 0;  ///< kept by the store
};

/// Whose outcomes a store holds, and what numbers an outcome consists of.
struct Manifest {
  std::string digest;  ///< of all that decides an outcome
  std::string name;
  std::uint64_t seed = 0;
  std::string source;  ///< the study file's JSON
  std::string folder;  ///< where recordings that it names are looked for
  std::vector<std::string> columns;
  std::vector<StoredCell> cells;
};

/// Two outcomes of the same trial are the same bits where these are equal.
struct Build {
  std::string version, compiler, flags;
  bool operator==(const Build&) const = default;
};

/// One run that wrote into a store.
struct Session {
  std::string digest;  ///< of the study as it was then
  Build build;
  std::string machine;
  std::int64_t process = 0;
  std::string started;      ///< UTC
  std::string progress;     ///< JSON, as of the last batch
  std::int64_t trials = 0;  ///< that it finished; kept by the store
};

/// A method that threw or broke down in a trial.
struct Failure {
  std::uint32_t cell = 0, trial = 0, method = 0;
  std::string reason;
};

/// A finished trial: `outcomes` has the manifest's columns for each method of the cell in turn.
struct TrialRow {
  std::uint32_t cell = 0, trial = 0;
  bool calibrated = true;
  std::vector<double> outcomes;
  std::vector<Failure> failures;
};

/// The outcomes of a study's finished trials, in one SQLite file with a write-ahead log. A trial is
/// there whole or not at all, whatever ends the program. One connection writes; any number read.
/// What is read is verified: names when the store is opened, trials and their number in passing.
/// Every member throws StoreError.
///
/// Example: a number of every finished trial of a run's first cell.
///
///   const Store store = Store::open("runs/study");
///   const Manifest manifest = store.manifest();
///   store.for_each_trial(0, manifest.cells[0].trials, [](const Store::TrialView& trial) {
///     std::printf("%u: %g\n", trial.trial, trial.outcomes[0]);
///   });
///
/// Thread safety: an object belongs to one thread at a time. Others, and other processes, may open
/// the same folder beside it to read, and see only whole trials.
class Store {
 public:
  /// A store in a folder has this name.
  static constexpr const char* file_name = "store.db";

  /// The store in `folder`, to be read; throws InputError where there is none.
  static Store open(const std::filesystem::path& folder);
  /// The store in `folder`, to be written by this process alone; made with `manifest` where there
  /// is none. What is there is checked from end to end.
  static Store open_or_create(const std::filesystem::path& folder, const Manifest& manifest);
  /// Renames the store in `folder`, so that nothing is destroyed; its new name, or nothing where
  /// there is no store.
  static std::optional<std::filesystem::path> set_aside(const std::filesystem::path& folder);

  /// What `repair` found.
  struct Repaired {
    std::int64_t kept = 0, dropped = 0;          ///< trials
    bool log_was_damaged = false;                ///< how many trials it held nobody knows
    std::optional<std::filesystem::path> aside;  ///< the damaged store's new name
    bool is_sound() const { return dropped == 0 && !log_was_damaged; }
  };
  /// Makes a store of all trials in `folder` that hold what they were written with, and renames the
  /// damaged one; nothing where it is sound. `named` is whose outcomes they are, where the store
  /// itself no longer knows. Trials beyond those last asked for are left behind.
  static Repaired repair(const std::filesystem::path& folder,
                         const std::optional<Manifest>& named = {});

  Manifest manifest() const;
  std::vector<Session> sessions() const;

  /// The study file's JSON as it is now; what decides outcomes has not changed in it.
  void set_source(std::string_view json);
  /// Numbers of trials asked for, cell by cell; cells that are not there yet are added.
  void set_cells(std::span<const StoredCell> cells);
  /// Rows written from now on are of this session.
  void begin_session(const Session& session);
  void note_progress(std::string_view json);

  /// Adds trials in one transaction; one that is there already must be the same, to the bit.
  void write(std::span<const TrialRow> rows);
  /// Adds all trials and failures of another store; the number of trials that were new.
  std::size_t merge(const std::filesystem::path& folder);

  struct TrialView {
    std::uint32_t trial;
    bool calibrated;
    std::span<const double> outcomes;
  };
  /// The finished trials of a cell below `limit`, in order.
  void for_each_trial(std::uint32_t cell, std::uint32_t limit,
                      const std::function<void(const TrialView&)>& visit) const;
  /// Everything in quarantine, in order.
  void for_each_failure(const std::function<void(const Failure&)>& visit) const;
  /// Trials of a cell below `limit` in which a method failed.
  std::uint32_t failed_trials(std::uint32_t cell, std::uint32_t limit) const;

 private:
  /// Held by the one process that may write; the system takes it back when the process ends.
  struct Lock {
    int file = -1;
    explicit Lock(const std::filesystem::path& folder);
    Lock(Lock&& other) noexcept : file(std::exchange(other.file, -1)) {}
    ~Lock();
  };
  Store(const std::filesystem::path& folder, sqlite::Access access);
  template <class Work>
  auto guarded(const Work& work) const;
  void require_still_there() const;

  std::filesystem::path path_;
  std::optional<Lock> lock_;
  std::unique_ptr<sqlite::Database> database_;
  std::int64_t session_ = 0;
  std::uint64_t device_ = 0, file_ = 0;  ///< which file it was when it was opened
};

}  // namespace gyrostat
