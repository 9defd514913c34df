#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/cli/diagnosed.hpp>
#include <gyrostat/experiments/findings/health.hpp>

namespace gyrostat::cli {

/// What recordings are watched by, in CI or by a monitor.
struct WatchArguments {
  std::vector<std::string> fail_if;
  std::string baseline;  ///< a study, whose simulator stands for the recordings
  bool json_lines = false;

  void add_to(CLI::App* verb);
  /// Of --fail-if; with a baseline and none of these, that the recording is not one of its own.
  std::vector<gap::HealthRule> rules(double significance) const;
  /// The simulator of the baseline as what is to be judged.
  void give_baseline(gap::DiagnosisOptions& options) const;
};

/// Tells which rules the diagnoses break, a line each; the exit code.
int judge_health(const std::vector<gap::FleetMember>& members, const std::string& file,
                 const std::vector<gap::HealthRule>& rules, Console& console);

/// Diagnoses each and prints a line of JSON for it. One that cannot be read has a line with the
/// error, and the others are diagnosed all the same; the exit code is then that of bad input.
int diagnose_in_lines(const std::vector<ToDiagnose>& all, const SpanOption& span,
                      const gap::DiagnosisOptions& options,
                      const std::vector<gap::HealthRule>& rules, Console& console);

}  // namespace gyrostat::cli
