#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace gyrostat {

/// Runs a program to its end, what it says of errors in `log`; its status as waitpid tells it.
/// Unlike std::system it leaves this process its own signals: the program hears of a Ctrl-C by
/// `stop`, and then gets one interrupt, wherever it came from.
int run_process(std::vector<std::string> arguments, const std::string& log,
                const std::atomic<bool>& stop);

}  // namespace gyrostat
