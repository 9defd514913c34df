#include <gyrostat/experiments/plugins/plugins.hpp>

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include <gyrostat/experiments/plugins/host.hpp>
#include <gyrostat/experiments/study/digest.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

std::vector<LoadedPlugin>& added() {
  static std::vector<LoadedPlugin> plugins;
  return plugins;
}

/// What `work` makes; InputError where a process fails at it.
template <class Work>
auto described(const std::string& place, const Work& work) {
  try {
    return work();
  } catch (const WorkerFailure& failure) {
    throw InputError(place, std::string(failure.what()) + " before it has described itself");
  }
}

/// What a process said of itself.
Json parsed(const std::string& place, const std::string& line) {
  auto json = Json::parse(line, nullptr, false);
  if (json.is_discarded() || !json.is_object())
    throw InputError(
        place,
        fmt::format("its first line is no JSON object: {}",
                    Json(line.substr(0, 60)).dump(-1, ' ', true, Json::error_handler_t::replace)));
  return json;
}

/// The words of a command line without a shell.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  char quote = 0;
  bool in_word = false;
  for (const char c : command) {
    if (quote != 0 ? c == quote : c == '"' || c == '\'') {
      quote = quote != 0 ? 0 : c;
      if (!in_word) words.emplace_back();
      in_word = true;
    } else if (quote == 0 && (c == ' ' || c == '\t')) {
      in_word = false;
    } else {
      if (!in_word) words.emplace_back();
      in_word = true;
      words.back() += c;
    }
  }
  if (quote != 0) throw InputError(command, fmt::format("a quote {} is not closed", quote));
  if (words.empty()) throw InputError("--filter-command", "the command is empty");
  return words;
}

/// The words, and the contents of those that are files.
std::string code_of(const std::vector<std::string>& words) {
  std::string code;
  for (const auto& word : words) {
    std::error_code none;
    code += fs::is_regular_file(word, none) ? file_digest(word) : word;
    code += '\n';
  }
  return digest(code);
}

void require_loadable(const std::string& path) {
  std::error_code none;
  if (!fs::exists(path, none)) throw InputError(path, "there is no such file");
  if (!fs::is_regular_file(path, none)) throw InputError(path, "is no file");
}

}  // namespace

LoadedPlugin load_library(const std::string& path, const PluginOptions& options) {
  require_loadable(path);
  LoadedPlugin plugin{.from = fs::absolute(path).lexically_normal().string()};
  const auto code = [file = plugin.from] { return file_digest(file); };
  const auto command = [&](const std::string& kind, const std::string& name) {
    return std::vector<std::string>{options.host, host_verb, plugin.from, kind, name};
  };
  const auto json = parsed(
      path, described(path, [&] { return Worker(command("", ""), options.limit_s).read_line(); }));
  const auto workers_of = [&](const std::string& kind, const std::string& name, const Json& entry) {
    return std::make_shared<Workers>(command(kind, name), options.limit_s, code, entry.dump());
  };
  Mistakes mistakes;
  JsonObject all(json, path + ":", &mistakes);
  if (const auto error = all.text("error", ""); !error.empty()) throw InputError(path, error);
  for (const auto& [filter, place] : all.list("filters"))
    all.attempt([&, entry = filter, at = place] {
      const auto said = read_filter_description(all.at(*entry, at));
      plugin.filters.push_back({said, workers_of("filter", said->name, *entry)});
    });
  for (const auto& [effect, place] : all.list("effects"))
    all.attempt([&, entry = effect, at = place] {
      const auto said = read_effect_description(all.at(*entry, at));
      plugin.effects.push_back({said, workers_of("effect", said->name, *entry)});
    });
  mistakes.raise();
  return plugin;
}

LoadedPlugin load_filter_command(const std::string& command, const PluginOptions& options) {
  const auto words = words_of(command);
  const auto workers = described(command, [&] {
    return std::make_shared<Workers>(words, options.limit_s, [words] { return code_of(words); });
  });
  auto json = parsed(command, workers->description());
  Mistakes mistakes;
  JsonObject object(json, command + ":", &mistakes);
  if (!object.has("protocol") || json["protocol"] != protocol::version)
    throw InputError(command,
                     fmt::format("speaks protocol {}; this gyrostat speaks {}",
                                 object.has("protocol") ? json["protocol"].dump() : "unknown",
                                 protocol::version));
  (void)object.text("version", "");
  LoadedPlugin plugin{.from = command, .is_library = false};
  object.attempt([&] { plugin.filters.push_back({read_filter_description(object), workers}); });
  mistakes.raise();
  return plugin;
}

void add_plugin(const LoadedPlugin& plugin) {
  const auto add_all = [&](const auto& list, auto& registry, const auto& type_of) {
    for (const auto& one : list) {
      const auto& name = one.description->name;
      if (registry.find(name))
        throw InputError(plugin.from,
                         fmt::format("'{}': there is another {} of this name", name,
                                     std::remove_cvref_t<decltype(registry[0])>::kind));
      registry.add(type_of(one));
    }
  };
  add_all(plugin.filters, filter_types(), filter_type_of);
  add_all(plugin.effects, effect_types(), effect_type_of);
  added().push_back(plugin);
}

const std::vector<LoadedPlugin>& added_plugins() { return added(); }

}  // namespace gyrostat
