#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/experiments/cli/diagnosed.hpp>

namespace gyrostat::cli {

/// Options, and whether each was given.
using Given = std::vector<std::pair<const char*, bool>>;

bool any(const Given& options);
/// Throws InputError at the first that was given.
void refuse(const Given& options, const std::string& why);

/// What `diagnose` writes of recordings, beside what it prints.
struct DiagnosisFiles {
  std::string json, html, scenario, figures;

  void add_to(CLI::App* verb);
  /// What is written of each diagnosis.
  Given of_each() const;
  /// Throws InputError where one cannot be written, or is the recording. The folder of figures,
  /// which goes again unless it is kept or was there before.
  TemporaryPath require_writable_beside(const std::string& recording) const;
  void write(const ToDiagnose& of, const SpanOption& span, const gap::Diagnosis& diagnosis) const;
  /// Likewise of each; `of` are what the members are of. The page, the JSON are of all together.
  void write_several(const std::vector<const ToDiagnose*>& of, const SpanOption& span,
                     const std::vector<gap::FleetMember>& members, const std::string& kind) const;

 private:
  /// All but the JSON; `suffix` tells the files of several apart.
  void write_one(const ToDiagnose& of, const SpanOption& span, const gap::Diagnosis& diagnosis,
                 const std::string& suffix = {}) const;
};

/// File and axis.
std::string called(const ToDiagnose& one);

}  // namespace gyrostat::cli
