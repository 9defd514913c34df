#pragma once

#include <string>
#include <vector>

#include <gyrostat/diagnosis/compare/comparison.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>

namespace gyrostat::cli {

/// `diagnose --simulated`: traces of the user's own simulator against recordings.
struct SimulatedArguments {
  std::vector<std::string> further;    ///< recordings beside the first
  std::vector<std::string> simulated;  ///< traces
  std::string out;                     ///< folder for the traces with what they lack
  std::string json_out, html_out;
};

/// All traces are read with the columns, units and axis of `recording`. The exit code; nothing is
/// written where Ctrl-C ended it.
int diagnose_simulated(const SimulatedArguments& arguments, const RecordingOption& recording,
                       const SpanOption& span, const gap::ComparisonOptions& options, Format format,
                       Console& console);

}  // namespace gyrostat::cli
