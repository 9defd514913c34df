#include <gyrostat/experiments/run/slurm.hpp>

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace gyrostat {
namespace {

/// As one word of a shell.
std::string word(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Whether it is one word as it stands.
bool is_plain(const std::string& text) {
  const auto is_safe = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; };
  return std::all_of(text.begin(), text.end(), is_safe);
}

}  // namespace

std::string sbatch_file(const SlurmJob& job) {
  std::string options;
  for (const auto& option : job.options)
    options += ' ' + (is_plain(option) ? option : word(option));
  return fmt::format(R"(#!/bin/sh
#SBATCH --job-name={name}
#SBATCH --array=1-{shards}
#SBATCH --cpus-per-task={threads}
#SBATCH --output={name}-%A_%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --signal=B:TERM@60
{time}
# Send it:            sbatch {name}.sbatch
# A failed task:      sbatch --array=3 {name}.sbatch    (runs only what shard 3 lacks)
# All at once:        {program} merge {folder} {folder}/shard_*
# The tables:         {program} run {study} --out {folder}

# The shell hands the signal that the time is up on, and the task ends in good order.
{program} run {study} --shard "$SLURM_ARRAY_TASK_ID/{shards}" --threads {threads} \
  --out {folder}/"shard_${{SLURM_ARRAY_TASK_ID}}_of_{shards}"{options} > /dev/null &
child=$!
trap 'kill -TERM "$child"' TERM
wait "$child"; code=$?
trap - TERM
[ "$code" -gt 128 ] && {{ wait "$child"; code=$?; }}
# 4: stopped, to be resumed; so the task goes back into the queue.
[ "$code" -eq 4 ] && scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}"
exit "$code"
)",
                     fmt::arg("name", job.name), fmt::arg("shards", job.shards),
                     fmt::arg("threads", job.threads),
                     fmt::arg("time", job.time.empty() ? "" : "#SBATCH --time=" + job.time + "\n"),
                     fmt::arg("program", word(job.program)), fmt::arg("study", word(job.study)),
                     fmt::arg("folder", word(job.folder)), fmt::arg("options", options));
}

}  // namespace gyrostat
