#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>

namespace gyrostat::cli {

/// The diagnosis of a span of a recording, at rest where it has no reference rate; nothing where
/// Ctrl-C ended it.
std::optional<gap::Diagnosis> diagnosed(const RecordingOption& recording, const SpanOption& span,
                                        const gap::DiagnosisOptions& options, Console& console);

/// `--axis all`, and several recordings: each diagnosed, then what they share. Writes JSON where
/// `json_out` is given.
int diagnose_members(const RecordingOption& recording, const std::vector<std::string>& further,
                     const SpanOption& span, const gap::DiagnosisOptions& options, Format format,
                     const std::string& json_out, Console& console);

}  // namespace gyrostat::cli
