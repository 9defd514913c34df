#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/plugin_options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/plugins/contract.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* check_plugin_examples = R"(Examples:
  gyrostat check-plugin my_filter.so
  gyrostat check-plugin --filter-command "python3 mine.py"
Exit code 0 where every law is kept, 1 where one is broken, 2 where it cannot be used at all.)";

struct CheckPluginArguments {
  PluginArguments plugins;
  FormatOption format;
};

int run(const CheckPluginArguments& arguments, Console& console) {
  const auto plugins = arguments.plugins.load();
  if (plugins.empty()) throw InputError("check-plugin", "a library or --filter-command is needed");
  bool all_kept = true;
  std::vector<Table> tables;
  for (const auto& plugin : plugins) {
    add_plugin(plugin);
    auto& table = tables.emplace_back(
        Table{.title = plugin.from, .columns = {{"plug-in", ""}, {"law", ""}, {"", ""}}});
    for (const auto& law : check_contract(plugin)) {
      all_kept = all_kept && law.broken_by.empty();
      table.rows.push_back(
          {law.plugin, law.law, law.broken_by.empty() ? "kept" : "BROKEN: " + law.broken_by});
    }
  }
  console.out << render(tables, arguments.format.get());
  return all_kept ? complete : error;
}

}  // namespace

void add_check_plugin(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "check-plugin", "hold a filter or effect of your own to what gyrostat expects of it");
  auto arguments = std::make_shared<CheckPluginArguments>();
  arguments->plugins.add_to(verb, "library");
  arguments->format.add_to(verb);
  verb->footer(check_plugin_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
