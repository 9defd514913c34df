#pragma once

#include <ostream>

#include <CLI/CLI.hpp>

#include <gyrostat/experiments/cli/stop_signal.hpp>

namespace gyrostat::cli {

/// What a verb may touch of the outside world.
struct Console {
  std::ostream& out;  ///< results
  std::ostream& log;  ///< progress and warnings
  bool log_is_terminal = false;
  StopSignal& stop;  ///< Ctrl-C and SIGTERM
};

/// Beside these, 128 + its number where a signal ended a verb at once.
enum ExitCode {
  complete = 0,
  error = 1,
  usage = 2,
  over_failure_budget = 3,
  stopped = 4,  ///< in good order: the same command goes on, or begins anew
  unhealthy = 5  ///< a recording fails by a rule
};

/// Adds the verb of every file in verbs/ to the program: those of verbs/order.txt in that order,
/// then the others by name. A verb that was called leaves its exit code in `exit_code`.
///
/// A file <verb>.cpp defines `void add_<verb>(CLI::App&, Console&, int& exit_code)`.
void add_verbs(CLI::App& program, Console& console, int& exit_code);

}  // namespace gyrostat::cli
