#include <gyrostat/experiments/findings/report/run_times.hpp>

#include <fstream>

#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {

std::map<std::string, std::map<std::string, double>> run_times(const std::filesystem::path& log) {
  std::map<std::string, std::map<std::string, double>> times;
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);) {
    const auto event = Json::parse(line, nullptr, false);
    if (!event.is_object() || !event.contains("ns_per_step") || !event.contains("cell") ||
        !event["cell"].is_string() || !event["ns_per_step"].is_object())
      continue;
    for (const auto& [method, ns] : event["ns_per_step"].items())
      if (ns.is_number()) times[event["cell"].get<std::string>()][method] = ns.get<double>();
  }
  return times;
}

}  // namespace gyrostat
