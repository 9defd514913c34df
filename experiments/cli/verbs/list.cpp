#include <gyrostat/diagnosis/gap/instrument.hpp>

#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* list_examples = R"(Examples:
  gyrostat list filters
  gyrostat list effects --json
  gyrostat list formats                of recordings, as --preset has them)";

constexpr const char* default_studies = "experiments/studies";

struct ListArguments {
  std::string kind = "all";
  std::string studies = default_studies;
  bool json = false;
};

Json described(std::span<const FieldInfo> fields) {
  auto list = Json::array();
  for (const auto& field : fields)
    list.push_back({{"name", field.name},
                    {"default", field.value},
                    {"unit", field.unit},
                    {"range", field.range.to_string()},
                    {"meaning", field.doc}});
  return list;
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
Json needed(std::span<std::vector<double> Series::*const> needs) {
  auto names = Json::array();
  for (const auto& channel : channels)
    if (std::ranges::find(needs, channel.values) != needs.end()) names.push_back(channel.name);
  return names;
}

template <class Types>
Json plugins(const Types& types) {
  auto list = Json::array();
  for (const auto& type : types) {
    Json entry = {{"id", type.id}, {"title", type.title}};
    if constexpr (requires { type.unit; }) entry["unit"] = type.unit;
    if constexpr (requires { type.stage; }) entry["stage"] = name_of(type.stage);
    if constexpr (requires { type.needs; }) entry["needs"] = needed(type.needs);
    if constexpr (requires { type.channel; }) entry["needs"] = Json::array({type.channel});
    entry["parameters"] = Json::array();
    if constexpr (requires { type.fields; }) entry["parameters"] = described(type.fields);
    list.push_back(std::move(entry));
  }
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
    out << wrapped(fmt::format("  {:<20} {}", entry["id"].get<std::string>(),
                               entry["title"].get<std::string>()),
                   2);
    for (const auto& p : entry["parameters"]) {
      const auto unit = p["unit"].get<std::string>();
      out << fmt::format("      {} = {:g}{}{}, {}\n", p["name"].get<std::string>(),
                         p["default"].get<double>(), unit == "1" ? "" : " ",
                         unit == "1" ? "" : unit, p["range"].get<std::string>());
      out << wrapped("          " + p["meaning"].get<std::string>());
    }
  }
}

int run(const ListArguments& arguments, Console& console) {
  const std::vector<std::pair<std::string, Json>> kinds = {
      {"filters", plugins(filter_types())},
      {"effects", plugins(effect_types())},
      {"temperatures", plugins(temperature_types())},
      {"motions", plugins(motion_types())},
      {"accelerations", plugins(acceleration_types())},
      {"metrics", plugins(metric_types())},
      {"lenses", plugins(gap::lens_types())},
      {"formats", plugins(format_types())},
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
                                      "accelerations, metrics, lenses, formats, studies");
  auto arguments = std::make_shared<ListArguments>();
  verb->add_option("kind", arguments->kind, "one of these kinds, or all")->capture_default_str();
  verb->add_option("--studies", arguments->studies, "folder of studies")->capture_default_str();
  verb->add_flag("--json", arguments->json, "as JSON, with every parameter's default and range");
  verb->footer(list_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
