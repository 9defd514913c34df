#include "analysis/gap/lenses/list.hpp"

#include <filesystem>

#include "analysis/metrics/list.hpp"
#include "core/filters/list.hpp"
#include "core/track.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/cli/verbs.hpp"
#include "experiments/json_object.hpp"
#include "generators/scenario.hpp"

namespace gyrostat::cli {
namespace {

constexpr const char* list_examples = R"(Examples:
  gyrostat list filters
  gyrostat list effects --json)";

constexpr const char* default_studies = "experiments/studies";

struct ListArguments {
  std::string kind = "all";
  std::string studies = default_studies;
  bool json = false;
};

template <class P>
Json described(const P& defaults) {
  auto list = Json::array();
  for (const auto& field : P::fields())
    list.push_back({{"name", field.name},
                    {"default", defaults.*(field.member)},
                    {"unit", field.unit},
                    {"range", field.range.to_string()},
                    {"meaning", field.doc}});
  return list;
}

/// A plug-in's parameters: its own members, or those of its Parameters type.
template <class Type>
Json parameters_of() {
  if constexpr (requires { typename Type::Parameters; })
    return described(typename Type::Parameters{});
  else if constexpr (requires { Type::fields(); })
    return described(Type{});
  else
    return Json::array();
}

std::string_view name_of(Stage stage) {
  switch (stage) {
    case Stage::environment:
      return "environment";
    case Stage::sensing:
      return "sensing";
    case Stage::noise:
      return "noise";
    case Stage::electronics:
      return "electronics";
    case Stage::conversion:
      return "conversion";
    case Stage::transport:
      return "transport";
    case Stage::compass:
      return "compass";
  }
  return "";
}

/// The channels that a filter cannot do without.
Json needed(const Needs& needs) { return missing_channels(needs, Series{}); }

/// The channels that an effect cannot do without.
template <std::size_t N>
Json needed(const std::array<std::vector<double> Series::*, N>& needs) {
  auto names = Json::array();
  for (const auto& channel : channels)
    if (std::ranges::find(needs, channel.values) != needs.end()) names.push_back(channel.name);
  return names;
}

template <class List>
Json plugins() {
  auto list = Json::array();
  List::for_each([&](auto plugin) {
    using Type = typename decltype(plugin)::type;
    Json entry = {{"id", plugin.id}, {"title", Type::title}};
    if constexpr (requires { Type::unit; }) entry["unit"] = Type::unit;
    if constexpr (requires { Type::stage; }) entry["stage"] = name_of(Type::stage);
    if constexpr (requires { Type::needs; }) entry["needs"] = needed(Type::needs);
    if constexpr (requires { Type::channel; }) entry["needs"] = Json::array({Type::channel});
    entry["parameters"] = parameters_of<Type>();
    list.push_back(std::move(entry));
  });
  return list;
}

Json studies(const std::string& folder, bool asked_for) {
  if (asked_for && !std::filesystem::is_directory(folder))
    throw InputError(folder, "no such folder");
  std::vector<std::string> paths;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  auto list = Json::array();
  for (const auto& path : paths) {
    const Json study = read_json(path);
    const auto title = JsonObject(study, path + ":").text("title", "");
    list.push_back({{"id", path}, {"title", title}, {"parameters", Json::array()}});
  }
  return list;
}

void print(const std::string& kind, const Json& entries, std::ostream& out) {
  out << kind << '\n';
  for (const auto& entry : entries) {
    out << fmt::format("  {:<20} {}\n", entry["id"].get<std::string>(),
                       entry["title"].get<std::string>());
    for (const auto& p : entry["parameters"]) {
      const auto unit = p["unit"].get<std::string>();
      out << fmt::format("      {:<28} {:<10} {:<10} {:<24} {}\n", p["name"].get<std::string>(),
                         fmt::format("{:g}", p["default"].get<double>()), unit == "1" ? "" : unit,
                         p["range"].get<std::string>(), p["meaning"].get<std::string>());
    }
  }
}

int run(const ListArguments& arguments, Console& console) {
  const std::vector<std::pair<std::string, Json>> kinds = {
      {"filters", plugins<Filters>()},
      {"effects", plugins<Effects>()},
      {"temperatures", plugins<Temperatures>()},
      {"motions", plugins<Motions>()},
      {"accelerations", plugins<Accelerations>()},
      {"metrics", plugins<Metrics>()},
      {"lenses", plugins<Lenses>()},
      {"studies", studies(arguments.studies, arguments.studies != default_studies)}};
  std::vector<std::string> names = {"all"};
  Json chosen;
  for (const auto& [name, entries] : kinds) {
    names.push_back(name);
    if (arguments.kind == "all" || arguments.kind == name) chosen[name] = entries;
  }
  if (chosen.is_null()) throw InputError("list", unknown_name("kind", arguments.kind, names));
  if (arguments.json) {
    console.out << (arguments.kind == "all" ? chosen : chosen[arguments.kind]).dump(2) << '\n';
    return complete;
  }
  for (const auto& [name, entries] : chosen.items()) print(name, entries, console.out);
  return complete;
}

}  // namespace

void add_list(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("list",
                                      "what there is: filters, effects, temperatures, motions, "
                                      "accelerations, metrics, lenses, studies");
  auto arguments = std::make_shared<ListArguments>();
  verb->add_option("kind", arguments->kind, "one of these kinds, or all")->capture_default_str();
  verb->add_option("--studies", arguments->studies, "folder of studies")->capture_default_str();
  verb->add_flag("--json", arguments->json, "as JSON, with every parameter's default and range");
  verb->footer(list_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
