#include <gyrostat/experiments/blind/blind_labels.hpp>

#include <fmt/format.h>

#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::gap {

namespace fs = std::filesystem;

void seal_labels(const fs::path& folder, const std::vector<BlindLabel>& labels) {
  Json all = Json::array();
  for (const auto& label : labels)
    all.push_back({{"recording", label.number},
                   {"effects", label.effects},
                   {"strength", label.strength},
                   {"duration_s", label.duration_s}});
  write_atomically(folder / "sealed_labels.json", all.dump(0) + '\n');
}

std::vector<BlindLabel> open_labels(const fs::path& folder) {
  std::vector<BlindLabel> labels;
  for (const auto& entry : read_json((folder / "sealed_labels.json").string()))
    labels.push_back({entry.at("recording").get<std::size_t>(),
                      entry.at("effects").get<std::vector<std::string>>(),
                      entry.at("strength").get<std::string>(), entry.value("duration_s", 0.0)});
  return labels;
}

fs::path diagnosis_of(const fs::path& folder, std::size_t number, bool left_out) {
  return folder / "diagnoses" / fmt::format("{:05}.{}", number, left_out ? "without.json" : "json");
}

}  // namespace gyrostat::gap
