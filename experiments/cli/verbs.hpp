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

/// Adds the verb of every file in verbs/ to the program: those of verbs/order.txt in that order,
/// then the others by name. A verb that was called leaves its exit code in `exit_code`.
///
/// A file <verb>.cpp defines `void add_<verb>(CLI::App&, Console&, int& exit_code)`.
void add_verbs(CLI::App& program, Console& console, int& exit_code);

}  // namespace gyrostat::cli
