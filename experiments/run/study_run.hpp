#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/experiments/run/run_log.hpp>
#include <gyrostat/experiments/run/stopper.hpp>
#include <gyrostat/experiments/run/stored_run.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>

namespace gyrostat {

struct StudyRunOptions {
  Shard shard{};
  int threads = 0;  ///< 0: as many as the machine has
  std::uint32_t lanes = default_lanes();
  Mismatch mismatch = Mismatch::refuse;
};

/// Who watches a run. Every member may be empty.
struct RunWatcher {
  /// A cell, or a design with all of its points, of so many trials is begun, and ended.
  std::function<void(const std::string& name, std::uint32_t trials)> begin{};
  std::function<void()> end{};
  /// From the writing thread, for each batch that is in the store.
  std::function<void(const CellProgress&)> progress{};
  std::function<void(const std::string& line)> say{};
};

/// A cell that was run, or found complete: what its tables need beside the store.
struct RanCell {
  std::uint32_t index = 0;  ///< in the study
  PreparedCell prepared{};
  std::vector<double> nanoseconds_per_step{};  ///< one a method; empty where nothing was to be run
  std::optional<std::string> stopped_by{};     ///< why its rule stopped it before all trials
};

/// A study on its way through the store of a folder: runs what is missing, cell by cell, as often
/// as it is begun, until a run is complete or `stopper` says so.
///
/// Thread safety: one process at a time may write a folder's store; the lock in it sees to that.
/// The watcher's members are called from this thread, `progress` from the one that writes.
class StudyRun {
 public:
  /// Opens or makes the store; throws InputError where it holds something else, see Mismatch.
  StudyRun(Study study, const std::filesystem::path& folder, const StudyRunOptions& options,
           Stopper& stopper, RunWatcher watcher);

  /// Every cell that was reached and stands for itself; points of sampled designs do not.
  std::vector<RanCell> run();

  /// With the trials of cells whose rule has stopped them.
  const Study& study() const { return study_; }
  const Store& store() const { return store_; }
  RunLog& log() { return log_; }
  std::uint32_t failed() const { return failed_; }  ///< trials, of earlier sessions too
  bool over_budget() const;

 private:
  void read_states();
  RanCell run_cell(std::uint32_t index);
  void run_design(const Design& design);
  struct Stretch;
  void run_missing_of(std::uint32_t cell, const PreparedCell& prepared, Stretch& stretch);
  void say(const std::string& line) const;

  Study study_;
  StudyRunOptions options_;
  Stopper& stopper_;
  RunWatcher watcher_;
  Store store_;
  RunLog log_;
  std::vector<CellState> states_;
  std::uint32_t failed_ = 0;
};

}  // namespace gyrostat
