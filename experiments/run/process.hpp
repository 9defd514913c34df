#pragma once

#include <string>
#include <vector>

namespace gyrostat {

/// Runs a program to its end, what it says of errors in `log`; its status as waitpid tells it.
/// Unlike std::system it leaves this process its own signals.
int run_process(std::vector<std::string> arguments, const std::string& log);

}  // namespace gyrostat
