#include <gyrostat/experiments/run/build.hpp>

#include <chrono>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>

#include <gyrostat/experiments/run/build_info.hpp>
#include <gyrostat/experiments/study/fleet.hpp>

namespace gyrostat {

Build this_build() {
  return {GYROSTAT_VERSION " " GYROSTAT_COMMIT, GYROSTAT_COMPILER, GYROSTAT_FLAGS};
}

namespace {

constexpr std::string_view before_plugins = " with ";

}  // namespace

Build build_for(const Study& study) {
  std::set<std::string> plugins;
  const auto note = [&](const auto* type) {
    if (type != nullptr && !type->code.empty())
      plugins.insert(fmt::format("{} {}", type->id, type->code));
  };
  for (const auto& cell : study.cells) {
    for (const auto& method : cell.methods) note(filter_types().find(method.filter));
    for (const auto& effect : cell.scenario.effects) note(&effect.type());
    if (!cell.fleet || !cell.fleet->draws_effects()) continue;
    for (const auto& unit : cell.fleet->units())
      for (const auto& effect : unit.scenario.effects) note(&effect.type());
  }
  auto build = this_build();
  if (!plugins.empty())
    build.version += fmt::format("{}{}", before_plugins, fmt::join(plugins, ", "));
  return build;
}

std::vector<std::string> plugins_of(const Build& build) {
  std::vector<std::string> names;
  const auto at = build.version.find(before_plugins);
  if (at == std::string::npos) return names;
  std::istringstream words(build.version.substr(at + before_plugins.size()));
  for (std::string name, code; words >> name >> code;) names.push_back(name);
  return names;
}

std::string this_machine() {
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  utsname system{};
  uname(&system);
  return fmt::format("{}, {} threads, {}, {} {}", processor, std::thread::hardware_concurrency(),
                     system.nodename, system.sysname, system.release);
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace gyrostat
