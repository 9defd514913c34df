#include <gyrostat/experiments/cli/plugin_options.hpp>

#include <array>

#include <gyrostat/experiments/cli/options.hpp>

namespace gyrostat::cli {
namespace {

/// The verbs that read a study or a store, or name a filter or an effect.
constexpr std::array with_plugins = {"run",     "plan",     "sensitivity", "status", "report",
                                     "replay",  "rank",     "consistency", "repair", "slurm",
                                     "apply",   "simulate", "list",        "schema", "validate",
                                     "publish", "tune"};

}  // namespace

void PluginArguments::add_to(CLI::App* verb, const std::string& libraries_as) {
  const bool is_option = libraries_as.starts_with('-');
  verb->add_option(libraries_as, libraries,
                   "shared library with filters or effects of your own; may stand several times")
      ->type_name("FILE.so")
      ->allow_extra_args(!is_option);
  verb->add_option("--filter-command", commands,
                   "command of a process that is a filter; may stand several times")
      ->type_name("COMMAND")
      ->allow_extra_args(false);
  verb->add_option("--plugin-limit", options.limit_s,
                   "time in which either answers a block of samples, s")
      ->check(within(0.01, 1e6, "s"))
      ->capture_default_str();
}

std::vector<LoadedPlugin> PluginArguments::load() const {
  std::vector<LoadedPlugin> plugins;
  for (const auto& path : libraries) plugins.push_back(load_library(path, options));
  for (const auto& command : commands) plugins.push_back(load_filter_command(command, options));
  return plugins;
}

void add_plugin_options(CLI::App& program) {
  auto arguments = std::make_shared<PluginArguments>();
  for (const auto* verb : with_plugins) arguments->add_to(program.get_subcommand(verb));
  program.parse_complete_callback([arguments] {
    for (const auto& plugin : arguments->load()) add_plugin(plugin);
  });
}

}  // namespace gyrostat::cli
