#include <gyrostat/diagnosis/diagnosis.hpp>

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/diagnosing.hpp>
#include <gyrostat/diagnosis/likelihood/alike.hpp>
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

void require_enough(const Series& recording) {
  if (recording.size() < fewest_samples)
    throw InputError("recording", fmt::format("{} samples; at least {} are needed for a diagnosis",
                                              recording.size(), fewest_samples));
  if (never_changes(recording.gyro_dps))
    throw InputError("recording", "gyro_dps never changes; there is nothing to diagnose");
}

/// Runs it, and again with another part held out where that may tell more, beside what is `given`.
Diagnosis run(Diagnosing& first, const Series& recording, const DiagnosisOptions& options,
              const std::vector<Given>& given, const DiagnosisProgress& progress,
              const Interrupt& interrupt) {
  Diagnosis found = first.run();
  if (!found.claimed && found.p_held_out < thresholds::p_of_the_unseen &&
      found.p_after >= thresholds::p_of_the_unexplained) {
    const DiagnosisProgress told_again = [&](const DiagnosisStage& stage) {
      constexpr double told = 0.95;
      if (progress) progress({stage.phase, stage.detail, told + (1.0 - told) * stage.share});
    };
    Diagnosing again(recording, options, told_again, interrupt, Split::in_other_parts);
    again.take(given);
    auto other = again.run();
    if (other.p_held_out >= thresholds::p_of_the_unseen && has_more_names(other, found)) {
      found = std::move(other);
      found.other_part_held_out = true;
    }
  }
  if (progress) progress({"done", "", 1.0});
  return found;
}

}  // namespace

std::vector<Effect> catalogue() {
  std::vector<Effect> all;
  for (const auto& cause : cause_types()) all.push_back(cause.effect());
  return all;
}

Diagnosis diagnose(const Series& recording, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress, const Interrupt& interrupt) {
  require_enough(recording);
  Diagnosing diagnosing(recording, options, progress, interrupt, Split::in_parts);
  return run(diagnosing, recording, options, {}, progress, interrupt);
}

std::vector<Diagnosis> diagnose_axes(
    const std::vector<Series>& axes, const DiagnosisOptions& options,
    const std::function<void(std::size_t, const DiagnosisStage&)>& progress,
    const Interrupt& interrupt) {
  std::vector<DiagnosisProgress> of_axis(axes.size());
  std::vector<std::unique_ptr<Diagnosing>> all;
  std::vector<FoundSet> found;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    require_enough(axes[k]);
    if (progress) of_axis[k] = [&progress, k](const auto& stage) { progress(k, stage); };
    all.push_back(
        std::make_unique<Diagnosing>(axes[k], options, of_axis[k], interrupt, Split::in_parts));
    found.push_back(all.back()->search());
  }
  const auto given = alike_on_axes(found);
  found.clear();
  std::vector<Diagnosis> diagnoses;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    all[k]->take(given[k]);
    diagnoses.push_back(run(*all[k], axes[k], options, given[k], of_axis[k], interrupt));
    all[k].reset();
  }
  return diagnoses;
}

}  // namespace gyrostat::gap
