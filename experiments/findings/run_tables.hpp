#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/run/study_run.hpp>

namespace gyrostat {

/// What a run says.
struct RunTables {
  std::vector<Table> tables;   ///< of the cells, in their order, and of sampled designs
  std::vector<Table> points;   ///< every point of the designs
  std::vector<Table> timings;  ///< of this run alone
  std::string answer;          ///< in a few sentences; empty where there is none

  /// The tables, with those of points that have no more than `most` rows.
  std::vector<Table> with_points(std::size_t most) const;
};

/// `folder` is the run's, where its failures are searched for.
RunTables run_tables(const Study& study, const Store& store, const std::vector<RanCell>& ran,
                     const std::filesystem::path& folder);

/// Writes outcomes.csv.gz, tables.json and tables.md beside the store, each whole or not at all.
void write_results(const std::filesystem::path& folder, const Store& store,
                   const RunTables& tables);

}  // namespace gyrostat
