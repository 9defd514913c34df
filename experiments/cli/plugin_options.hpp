#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <gyrostat/experiments/plugins/plugins.hpp>

namespace gyrostat::cli {

/// `--plugin`, `--filter-command` and `--plugin-limit`: filters and effects that are not part of
/// the program.
struct PluginArguments {
  std::vector<std::string> libraries, commands;
  PluginOptions options;

  /// `libraries_as`: the option that names libraries, or the argument.
  void add_to(CLI::App* verb, const std::string& libraries_as = "--plugin");
  /// In the order of the two lists; throws InputError where one cannot be used.
  std::vector<LoadedPlugin> load() const;
};

/// Gives these options to every verb that names filters or effects. They are loaded once the
/// command line is read, before the verb begins.
void add_plugin_options(CLI::App& program);

}  // namespace gyrostat::cli
