#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include <gyrostat/analysis/rare/subset_simulation.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/study_run.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// So many plain trials of a method have to fail that they alone tell its failure's probability: a
/// coefficient of variation of a tenth.
inline constexpr std::uint32_t enough_failing = 100;

/// The searches for failures have a store of their own in this folder of a run.
inline constexpr const char* failure_folder = "failure";

/// The study of a study's failures: a cell "ramp/kf" for each method of a cell whose failure is
/// asked for, with that method alone, in their order. Its trials are those of its FailureSearch.
Study failure_study(const Study& study);

/// The seed of all deviates that failures are looked for in: other than those of plain trials.
std::uint64_t failure_seed(const Study& study);

/// The runs of subset simulation that look for the failure of one method, side by side: a function
/// of what they were told.
class FailureSearch {
 public:
  explicit FailureSearch(const FailureRule& rule);

  /// The same, told of all that the store has of a failure study's cell, as far as it goes.
  FailureSearch(const FailureRule& rule, const Store& store, std::uint32_t cell);

  /// The trials that it waits for, those of the first run first; none once all runs have ended.
  std::vector<SubsetMove> asked() const;
  void tell(std::span<const double> badness);

  const std::vector<SubsetSimulation>& runs() const { return runs_; }
  /// The run that a trial is of.
  const SubsetSimulation& run_of(std::uint32_t trial) const {
    return runs_[trial / plan_.numbers()];
  }
  std::uint32_t trials() const;  ///< that it was told of
  bool reached() const;          ///< whether every run did
  std::uint32_t numbers() const {
    return plan_.numbers() * static_cast<std::uint32_t>(runs_.size());
  }

 private:
  SubsetPlan plan_;
  std::vector<SubsetSimulation> runs_;
};

/// How many of a method's finished plain trials fail.
struct PlainFailures {
  std::uint32_t failing = 0, trials = 0;
  bool is_enough() const { return failing >= enough_failing; }
};
PlainFailures plain_failures(const Store& store, std::uint32_t index, const Cell& cell,
                             std::size_t method);

/// Looks for the failures of a study's cells, where plain trials do not tell them, from where the
/// store in `folder`/failure ends. Cells that are not among `ran` (points of a design) are prepared
/// anew. Trials run side by side and on any number of threads;
/// which there are depends on the outcomes of those before alone. `plain` is the run's own store.
void run_failures(const Study& study, const Store& plain, std::span<const RanCell> ran,
                  const std::filesystem::path& folder, const StudyRunOptions& options,
                  const std::atomic<bool>& stop, const RunWatcher& watcher);

}  // namespace gyrostat
