#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/generators/effect.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::cli {
namespace {

using Words = std::vector<std::string>;

constexpr const char* completion_examples = R"(Examples:
  source <(gyrostat completion bash)                                    in ~/.bashrc
  source <(gyrostat completion zsh)                                     in ~/.zshrc, after compinit
  gyrostat completion fish > ~/.config/fish/completions/gyrostat.fish)";

/// What may stand behind an option, or as first argument of a verb, where it is no file.
Words choices(const std::string& verb, const std::string& option) {
  static const std::map<std::string, Words> of_option = {
      {"--format", {"text", "md", "csv", "json", "latex"}},
      {"--axis", {"x", "y", "z"}},
      {"--fit", {"likelihood", "moments"}},
      {"--method", {"likelihood", "moments"}},
      {"--lanes", {"1", "2", "4", "8"}},
      {"--preset", format_types().ids()},
      {"--without", effect_types().ids()}};
  static const std::map<std::string, Words> of_verb = {
      {"list",
       {"all", "filters", "effects", "temperatures", "motions", "accelerations", "metrics",
        "lenses", "formats", "studies"}},
      {"completion", {"bash", "zsh", "fish"}}};
  const auto& known = option.empty() ? of_verb : of_option;
  const auto found = known.find(option.empty() ? verb : option);
  return found == known.end() ? Words{} : found->second;
}

/// The long options of a verb.
std::vector<const CLI::Option*> options_of(const CLI::App& verb) {
  std::vector<const CLI::Option*> options;
  for (const auto* option : verb.get_options())
    if (!option->get_lnames().empty()) options.push_back(option);
  return options;
}

std::string name_of(const CLI::Option* option) { return "--" + option->get_lnames().front(); }

/// For bash, and for zsh in its way of taking bash's completions.
std::string bash_script(const CLI::App& program) {
  Words verbs, of_options, of_verbs;
  for (const auto* verb : program.get_subcommands({})) {
    const auto& name = verb->get_name();
    verbs.push_back(name);
    Words options;
    for (const auto* option : options_of(*verb)) {
      options.push_back(name_of(option));
      if (option->get_items_expected_max() == 0) continue;  // a flag: what follows is an argument
      const auto values = choices(name, options.back());
      of_options.push_back(
          fmt::format("    \"{} {}\") words=\"{}\" ;;", name, options.back(),
                      values.empty() ? "FILES" : fmt::format("{}", fmt::join(values, " "))));
    }
    of_verbs.push_back(fmt::format("      {}) options=\"{}\" words=\"{}\" ;;", name,
                                   fmt::join(options, " "), fmt::join(choices(name, ""), " ")));
  }
  return fmt::format(R"(_gyrostat() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb=${{COMP_WORDS[1]}}
  local words="" options=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "$verb $before" in
{}
    *) case "$verb" in
{}
    esac ;;
  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) [ -n "$words" ] && [ "$words" != FILES ] && COMPREPLY=($(compgen -W "$words" -- "$word")) && return
       COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _gyrostat gyrostat
)",
                     fmt::join(verbs, " "), fmt::join(of_options, "\n"), fmt::join(of_verbs, "\n"));
}

std::string zsh_script(const CLI::App& program) {
  return "autoload -U +X bashcompinit && bashcompinit\n" + bash_script(program);
}

/// In single quotes, as fish reads them.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text)
    safe += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return safe + "'";
}

std::string fish_script(const CLI::App& program) {
  std::string script;
  for (const auto* verb : program.get_subcommands({})) {
    const auto& name = verb->get_name();
    script += fmt::format("complete -c gyrostat -n __fish_use_subcommand -f -a {} -d {}\n", name,
                          quoted(verb->get_description()));
    const auto here = fmt::format("complete -c gyrostat -n '__fish_seen_subcommand_from {}'", name);
    if (const auto values = choices(name, ""); !values.empty())
      script += fmt::format("{} -f -a '{}'\n", here, fmt::join(values, " "));
    for (const auto* option : options_of(*verb)) {
      const auto values = choices(name, name_of(option));
      const bool is_flag = option->get_items_expected_max() == 0;
      script += fmt::format("{} -l {} -d {}", here, option->get_lnames().front(),
                            quoted(option->get_description()));
      if (!values.empty())
        script += fmt::format(" -x -a '{}'", fmt::join(values, " "));
      else if (!is_flag)
        script += " -r";
      script += '\n';
    }
  }
  return script;
}

const std::map<std::string, std::function<std::string(const CLI::App&)>> shells = {
    {"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}};

}  // namespace

void add_completion(CLI::App& program, Console& console, int& exit_code) {
  auto* verb =
      program.add_subcommand("completion", "completion of verbs, options and names for a shell");
  auto shell = std::make_shared<std::string>();
  verb->add_option("shell", *shell, "bash, zsh or fish")->required();
  verb->footer(completion_examples);
  verb->callback([shell, &program, &console, &exit_code] {
    Words names;
    for (const auto& [name, script] : shells) names.push_back(name);
    const auto script = shells.find(*shell);
    if (script == shells.end())
      throw InputError("completion", unknown_name("shell", *shell, names));
    console.out << script->second(program);
    exit_code = complete;
  });
}

}  // namespace gyrostat::cli
