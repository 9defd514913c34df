#include <gyrostat/diagnosis/diagnosis.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/diagnosing.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>
#include <gyrostat/diagnosis/views.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_samples = 1000;

bool has_more_names(const Diagnosis& one, const Diagnosis& other) {
  return std::any_of(one.effects.begin(), one.effects.end(), [&](const auto& included) {
    return std::none_of(other.effects.begin(), other.effects.end(),
                        [&](const auto& e) { return e.effect == included.effect; });
  });
}

}  // namespace

std::vector<Effect> catalogue() {
  std::vector<Effect> all;
  for (const auto& cause : cause_types()) all.push_back(cause.effect());
  return all;
}

Diagnosis diagnose(const Series& recording, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress, const Interrupt& interrupt) {
  if (recording.size() < fewest_samples)
    throw InputError("recording", fmt::format("{} samples; at least {} are needed for a diagnosis",
                                              recording.size(), fewest_samples));
  if (never_changes(recording.gyro_dps))
    throw InputError("recording", "gyro_dps never changes; there is nothing to diagnose");
  Diagnosis found = Diagnosing(recording, options, progress, interrupt, Split::in_parts).run();
  if (!found.claimed && found.p_held_out < thresholds::p_of_the_unseen &&
      found.p_after >= thresholds::p_of_the_unexplained) {
    const auto told_again = [&](const DiagnosisStage& stage) {
      constexpr double told = 0.95;
      if (progress) progress({stage.phase, stage.detail, told + (1.0 - told) * stage.share});
    };
    auto other = Diagnosing(recording, options, told_again, interrupt, Split::in_other_parts).run();
    if (other.p_held_out >= thresholds::p_of_the_unseen && has_more_names(other, found)) {
      found = std::move(other);
      found.other_part_held_out = true;
    }
  }
  if (progress) progress({"done", "", 1.0});
  return found;
}

}  // namespace gyrostat::gap
