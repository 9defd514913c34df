#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gyrostat::gap {

/// What is in a recording of a blind check, sealed until it is scored.
struct BlindLabel {
  std::size_t number = 0;
  std::vector<std::string> effects;
  std::string strength;
  double duration_s = 0.0;

  bool is_strong_single() const { return effects.size() == 1 && strength == "strong"; }
};

void seal_labels(const std::filesystem::path& folder, const std::vector<BlindLabel>& labels);
std::vector<BlindLabel> open_labels(const std::filesystem::path& folder);

/// The diagnosis of a recording; without its effect in the catalogue where `left_out`.
std::filesystem::path diagnosis_of(const std::filesystem::path& folder, std::size_t number,
                                   bool left_out);

}  // namespace gyrostat::gap
