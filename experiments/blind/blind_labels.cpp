#include <gyrostat/experiments/blind/blind_labels.hpp>

#include <fmt/format.h>

#include <gyrostat/experiments/blind/blind_check.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::gap {

namespace fs = std::filesystem;

BlindLabel label_of(const BlindCase& c, std::size_t number) {
  return {.number = number,
          .effects = c.effects,
          .strength = c.strength,
          .duration_s = c.scenario.sampling.duration_s,
          .rate_hz = c.scenario.sampling.rate_hz,
          .scenario = c.scenario_name,
          .form = c.form,
          .noise = c.noises.empty() ? "" : c.noises.front().name,
          .own = c.own,
          .without = c.without,
          .left_out = c.left_out};
}

Json labels_json(const std::vector<BlindLabel>& labels) {
  Json all = Json::array();
  for (const auto& label : labels)
    all.push_back({{"recording", label.number},
                   {"effects", label.effects},
                   {"strength", label.strength},
                   {"duration_s", label.duration_s},
                   {"rate_hz", label.rate_hz},
                   {"scenario", label.scenario},
                   {"form", label.form},
                   {"noise", label.noise},
                   {"own", label.own},
                   {"without", label.without},
                   {"left_out", label.left_out}});
  return all;
}

std::vector<BlindLabel> labels_in(const Json& json, const std::string& place) try {
  using Names = std::vector<std::string>;
  std::vector<BlindLabel> labels;
  for (const auto& entry : json)
    labels.push_back({.number = entry.at("recording").get<std::size_t>(),
                      .effects = entry.at("effects").get<Names>(),
                      .strength = entry.at("strength").get<std::string>(),
                      .duration_s = entry.at("duration_s").get<double>(),
                      .rate_hz = entry.at("rate_hz").get<double>(),
                      .scenario = entry.at("scenario").get<std::string>(),
                      .form = entry.at("form").get<std::string>(),
                      .noise = entry.at("noise").get<std::string>(),
                      .own = entry.at("own").get<Names>(),
                      .without = entry.at("without").get<Names>(),
                      .left_out = entry.at("left_out").get<std::string>()});
  return labels;
} catch (const Json::exception&) {
  throw InputError(place, "does not hold the labels of a blind check");
}

void seal_labels(const fs::path& folder, const std::vector<BlindLabel>& labels) {
  write_atomically(folder / "sealed_labels.json", labels_json(labels).dump(0) + '\n');
}

std::vector<BlindLabel> open_labels(const fs::path& folder) {
  const auto file = (folder / "sealed_labels.json").string();
  return labels_in(read_json(file), file);
}

fs::path recording_of(const fs::path& folder, std::size_t number) {
  return folder / "recordings" / fmt::format("{:05}.csv.gz", number);
}

fs::path diagnosis_of(const fs::path& folder, std::size_t number, bool left_out) {
  return folder / "diagnoses" / fmt::format("{:05}.{}", number, left_out ? "without.json" : "json");
}

}  // namespace gyrostat::gap
