#pragma once

#include <string>
#include <vector>

namespace gyrostat {

/// What a job array for a study needs to know.
struct SlurmJob {
  std::string program;  ///< absolute path
  std::string study;    ///< absolute path
  std::string name;
  std::string folder;  ///< absolute path: the shards' folders go below it
  int shards = 8;
  int threads = 1;
  std::string time;  ///< limit of a task, as Slurm writes it; empty: the partition's
  std::vector<std::string> options;  ///< further arguments of `gyrostat run`
};

/// An sbatch file: one task a shard, sent again where a node fails or the time is up. Each task has
/// a folder of its own, for SQLite's log does not work across machines.
std::string sbatch_file(const SlurmJob& job);

}  // namespace gyrostat
