#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/shared_effects.hpp>

namespace gyrostat::cli {

/// A recording that is to be diagnosed, and what it is called among others.
struct ToDiagnose {
  RecordingOption recording;
  std::string name;
  bool axis_was_chosen = true;
};

/// Several recordings, and of each that has several axes every one unless one is chosen; a column
/// gyro_dps is chosen, and others beside it are of the motion.
std::vector<ToDiagnose> each_of(const RecordingOption& recording,
                                const std::vector<std::string>& further);

enum class Parts { allowed, refused };

/// The diagnoses of a span of a recording, at rest where it has no reference rate: one, or one of
/// each view of a long recording (refused where `parts` says so; a claim says nothing of means).
/// None, which is told, of an axis that was not chosen and does not turn with the reference rate.
/// Nothing where Ctrl-C ended it.
std::optional<std::vector<gap::FleetMember>> diagnosed(const ToDiagnose& one,
                                                       const SpanOption& span,
                                                       const gap::DiagnosisOptions& options,
                                                       Parts parts, Console& console);

/// Each that was looked at sample by sample and what these share, and the means of long recordings.
nlohmann::ordered_json members_json(const std::vector<gap::FleetMember>& members,
                                    const std::string& kind);

}  // namespace gyrostat::cli
