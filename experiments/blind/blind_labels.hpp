#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat::gap {

struct BlindCase;
struct BlindCheck;

inline bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What is in a recording of a blind check, sealed until it is scored.
struct BlindLabel {
  std::size_t number = 0;
  std::vector<std::string> effects;
  std::string strength;
  double duration_s = 0.0;
  double rate_hz = 0.0;
  std::string scenario{}, form{}, noise{};
  std::vector<std::string> own{};      ///< neither right nor wrong
  std::vector<std::string> without{};  ///< what the diagnosing simulator lacks
  std::string left_out{};              ///< diagnosed once more without it, too
};

BlindLabel label_of(const BlindCase& c, std::size_t number);

/// Writes the recordings of a check, one a case, under `folder`, and returns their labels.
std::vector<BlindLabel> write_recordings(const BlindCheck& check,
                                         const std::vector<BlindCase>& cases,
                                         const std::filesystem::path& folder,
                                         const Interrupt& interrupt = {});

Json labels_json(const std::vector<BlindLabel>& labels);
/// InputError at `place` where they are none.
std::vector<BlindLabel> labels_in(const Json& json, const std::string& place);

void seal_labels(const std::filesystem::path& folder, const std::vector<BlindLabel>& labels);
std::vector<BlindLabel> open_labels(const std::filesystem::path& folder);

/// A recording of a check, and its diagnosis; with one of its effects left out of the catalogue
/// where `left_out`.
std::filesystem::path recording_of(const std::filesystem::path& folder, std::size_t number);
std::filesystem::path diagnosis_of(const std::filesystem::path& folder, std::size_t number,
                                   bool left_out);

}  // namespace gyrostat::gap
