#pragma once

#include <cstddef>
#include <string>
#include <utility>
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

/// What is looked at of a span of a recording, at rest where it has no reference rate: all of it,
/// or the views of a long one (refused where `parts` says so; a claim says nothing of means).
struct LookedAt {
  std::string file;
  std::vector<gap::FleetMember> members{};
  std::vector<Series> series{};    ///< of each member
  std::vector<double> begins_s{};  ///< each, from the first sample of the recording
  bool is_whole = true;            ///< so that there is one
};

/// Nothing, which is told, of an axis that was not chosen and does not turn with the reference
/// rate.
LookedAt looked_at(const ToDiagnose& one, const SpanOption& span,
                   const gap::DiagnosisOptions& options, Parts parts, Console& console);

/// Diagnoses the members of each of one file's axes, those that are looked at whole together. False
/// where Ctrl-C ended it.
bool diagnose_members(std::vector<LookedAt>& axes, const gap::DiagnosisOptions& options,
                      Console& console);

/// Those of one file after another: of each its first and the one after its last.
std::vector<std::pair<std::size_t, std::size_t>> by_file(const std::vector<ToDiagnose>& all);

/// Each that was looked at sample by sample and what these share, and the means of long recordings.
nlohmann::ordered_json members_json(const std::vector<gap::FleetMember>& members,
                                    const std::string& kind);

}  // namespace gyrostat::cli
