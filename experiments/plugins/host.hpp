#pragma once

#include <string>

namespace gyrostat {

/// The verb that the program calls itself by to be the process of a library:
/// `gyrostat plugin-host FILE` describes all that it holds and ends; `… FILE filter NAME` and
/// `… FILE effect NAME` describe that one, and serve it on standard input and output.
inline constexpr const char* host_verb = "plugin-host";

/// Is that process, from its arguments; returns its exit code.
int host_plugin(const std::string& file, const std::string& kind, const std::string& name);

}  // namespace gyrostat
