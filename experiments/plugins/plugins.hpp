#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gyrostat/experiments/plugins/foreign_effect.hpp>
#include <gyrostat/experiments/plugins/foreign_filter.hpp>

namespace gyrostat {

/// Filters and effects that are not part of the program, and how they are run.
struct PluginOptions {
  /// The program as whose process a library is loaded (host.hpp).
  std::string host = "/proc/self/exe";
  /// Seconds in which a block of samples, or the start, is answered.
  double limit_s = 30.0;
};

/// What one library or command holds.
struct LoadedPlugin {
  std::string from;  ///< the library's absolute path, or the command
  bool is_library = true;
  std::vector<ForeignFilter> filters{};
  std::vector<ForeignEffect> effects{};
};

/// The filters and effects of a shared library for gyrostat_plugin.h. Throws InputError where it
/// cannot be used: in one line what is missing, or which version it is built for.
LoadedPlugin load_library(const std::string& path, const PluginOptions& options);

/// The filter of a process that is started by `command`, which is cut into words at spaces (quotes
/// keep them together) and run without a shell. Throws InputError where it does not describe
/// itself.
LoadedPlugin load_filter_command(const std::string& command, const PluginOptions& options);

/// From here on they stand beside those of the program. Throws InputError where a name is taken.
void add_plugin(const LoadedPlugin& plugin);

/// Those that were added, in their order.
const std::vector<LoadedPlugin>& added_plugins();

}  // namespace gyrostat
