#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/diagnosis/verdict.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>

namespace gyrostat::gap {

/// What was said of a recording, by `gyrostat diagnose --json` or by any other method that writes a
/// part of the same: the verdict at least.
struct BlindAnswer {
  Verdict verdict = Verdict::none();
  std::vector<Verdict> verdict_set;
  std::vector<std::pair<std::string, double>> inclusions;  ///< those that close most first
  std::optional<double> closed;
  std::optional<double> log_score_gained;
  std::optional<std::pair<double, double>> closed_interval;

  /// Effects that are rather there than not.
  std::vector<std::string> named() const;
};

/// InputError with file and JSON path where it is none.
BlindAnswer read_answer(const std::filesystem::path& path);

/// An answer without what is neither right nor wrong of its recording: where the verdict is such an
/// effect, the next one named is the verdict.
BlindAnswer without_own(BlindAnswer answer, const BlindLabel& label);

/// Whether a verdict is right of a recording.
bool is_right(const Verdict& verdict, const BlindLabel& label);

}  // namespace gyrostat::gap
