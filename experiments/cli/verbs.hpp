#pragma once

#include <atomic>
#include <ostream>

#include <CLI/CLI.hpp>

namespace gyrostat::cli {

/// What a verb may touch of the outside world.
struct Console {
  std::ostream& out;  ///< results
  std::ostream& log;  ///< progress and warnings
  bool log_is_terminal = false;
  const std::atomic<bool>& stop;  ///< set by Ctrl-C
};

enum ExitCode { complete = 0, error = 1, usage = 2, over_failure_budget = 3, stopped = 4 };

/// Each adds its verb to the program. A verb that was called leaves its exit code in `exit_code`.
void add_run(CLI::App& program, Console& console, int& exit_code);
void add_export(CLI::App& program, Console& console, int& exit_code);
void add_report(CLI::App& program, Console& console, int& exit_code);
void add_replay(CLI::App& program, Console& console, int& exit_code);
void add_sensitivity(CLI::App& program, Console& console, int& exit_code);
void add_status(CLI::App& program, Console& console, int& exit_code);
void add_merge(CLI::App& program, Console& console, int& exit_code);
void add_rank(CLI::App& program, Console& console, int& exit_code);
void add_coverage(CLI::App& program, Console& console, int& exit_code);
void add_consistency(CLI::App& program, Console& console, int& exit_code);
void add_slurm(CLI::App& program, Console& console, int& exit_code);
void add_plan(CLI::App& program, Console& console, int& exit_code);
void add_fit(CLI::App& program, Console& console, int& exit_code);
void add_apply(CLI::App& program, Console& console, int& exit_code);
void add_simulate(CLI::App& program, Console& console, int& exit_code);
void add_allan(CLI::App& program, Console& console, int& exit_code);
void add_match(CLI::App& program, Console& console, int& exit_code);
void add_ledger(CLI::App& program, Console& console, int& exit_code);
void add_publish(CLI::App& program, Console& console, int& exit_code);
void add_diagnose(CLI::App& program, Console& console, int& exit_code);
void add_blind_check(CLI::App& program, Console& console, int& exit_code);
void add_list(CLI::App& program, Console& console, int& exit_code);
void add_validate(CLI::App& program, Console& console, int& exit_code);
void add_schema(CLI::App& program, Console& console, int& exit_code);
void add_completion(CLI::App& program, Console& console, int& exit_code);

}  // namespace gyrostat::cli
