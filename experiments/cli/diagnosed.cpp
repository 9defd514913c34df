#include <gyrostat/experiments/cli/diagnosed.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <gyrostat/diagnosis/of_the_sensor.hpp>
#include <gyrostat/diagnosis/own_reference.hpp>
#include <gyrostat/diagnosis/views.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

/// Without what is not the sensor's, which is told.
Series of_the_sensor(Series recording, const std::string& file, std::ostream& log) {
  std::vector<std::string> told;
  Series series = gap::of_the_sensor(std::move(recording), told);
  for (const auto& line : told) log << fmt::format("{}: {}\n", file, line);
  return series;
}

/// Random errors are steps a sample: at another rate they are others.
void require_rate_of(const std::optional<Scenario>& claim, const Series& series,
                     const std::string& file) {
  constexpr double most_apart = 0.01;
  if (claim && std::abs(claim->sampling.rate_hz / series.rate_hz() - 1.0) > most_apart)
    throw InputError(file, fmt::format("sampled at {:.6g} Hz, the simulator that it is held to at "
                                       "{:.6g} Hz; allowed: the same within 1 %",
                                       series.rate_hz(), claim->sampling.rate_hz));
}

std::string name_of(const gap::View& view, const std::string& recording, const Series& looked_at,
                    double begun_s) {
  auto name = recording + (recording.empty() ? "" : " ");
  if (view.mean_of > 1) name += fmt::format("means of {}, ", view.mean_of);
  return name + fmt::format("{:.6g} to {:.6g} s", looked_at.t_s.front() - begun_s,
                            looked_at.t_s.back() - begun_s);
}

/// Its times are from the first sample of the recording, not from where it was looked at.
gap::Diagnosis timed_from(double begins_s, gap::Diagnosis diagnosis) {
  if (auto& once = diagnosis.transient) {
    once->from_s += begins_s;
    once->to_s += begins_s;
  }
  for (auto* envelope : {&diagnosis.portrait.recorded, &diagnosis.portrait.left})
    for (double& t_s : envelope->t_s) t_s += begins_s;
  return diagnosis;
}

/// In one go, so that what they have alike is fitted once.
void diagnose_together(const std::vector<LookedAt*>& axes, const gap::DiagnosisOptions& options,
                       const Interrupt& interrupt, Console& console) {
  PhaseProgress progress(console.log, console.log_is_terminal, "diagnose");
  std::vector<double> shares(axes.size(), 0.0);
  std::vector<Series> series;
  for (auto* axis : axes) series.push_back(std::move(axis->series.front()));
  auto diagnoses = gap::diagnose_axes(
      series, options,
      [&](std::size_t axis, const gap::DiagnosisStage& now) {
        shares[axis] = now.share;
        progress.set(axes[axis]->members.front().name + ": " + now.phase, now.detail,
                     std::accumulate(shares.begin(), shares.end(), 0.0) /
                         static_cast<double>(shares.size()));
      },
      interrupt);
  for (std::size_t k = 0; k < axes.size(); ++k)
    axes[k]->members.front().diagnosis =
        timed_from(axes[k]->begins_s.front(), std::move(diagnoses[k]));
}

void diagnose_each(LookedAt& one, const gap::DiagnosisOptions& options, const Interrupt& interrupt,
                   Console& console) {
  for (std::size_t k = 0; k < one.members.size(); ++k) {
    if (!one.is_whole) console.log << one.members[k].name << '\n';
    interrupt.check();
    PhaseProgress progress(console.log, console.log_is_terminal, "diagnose");
    one.members[k].diagnosis = timed_from(
        one.begins_s[k],
        gap::diagnose(
            one.series[k], options,
            [&](const auto& now) { progress.set(now.phase, now.detail, now.share); }, interrupt));
  }
}

/// What cannot be read says so when it is diagnosed; standard input is read but once.
std::vector<std::string> axes_of(const RecordingOption& recording, const std::string& file) {
  const bool is_open = recording.axis.empty() || recording.axis == every_axis;
  if (!is_open || file == "-") return {recording.axis};
  try {
    auto axes = gyro_axes(file, recording.layout());
    const bool has_its_own = std::find(axes.begin(), axes.end(), "") != axes.end();
    if (axes.size() > 1 && !(has_its_own && recording.axis.empty())) return axes;
  } catch (const InputError&) {
  }
  return {""};
}

}  // namespace

std::vector<ToDiagnose> each_of(const RecordingOption& recording,
                                const std::vector<std::string>& further) {
  std::vector<std::string> files = {recording.file};
  files.insert(files.end(), further.begin(), further.end());
  std::vector<ToDiagnose> all;
  std::set<std::string> names;
  for (const auto& file : files) {
    const auto axes = axes_of(recording, file);
    for (const auto& axis : axes) {
      const std::string called = axis.empty() && axes.size() > 1 ? "gyro_dps" : axis;
      ToDiagnose one{recording, files.size() == 1 ? called : fs::path(file).filename().string()};
      if (files.size() > 1 && axes.size() > 1) one.name += ' ' + called;
      if (!names.insert(one.name).second) one.name = file + (axes.size() > 1 ? ' ' + axis : "");
      one.recording.file = file;
      one.recording.axis = axis;
      one.axis_was_chosen = axes.size() == 1;
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::vector<std::pair<std::size_t, std::size_t>> by_file(const std::vector<ToDiagnose>& all) {
  std::vector<std::pair<std::size_t, std::size_t>> files;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k > 0 && all[k].recording.file == all[k - 1].recording.file &&
        all[k].recording.axis != all[files.back().first].recording.axis)
      files.back().second = k + 1;
    else
      files.emplace_back(k, k + 1);
  return files;
}

LookedAt looked_at(const ToDiagnose& one, const SpanOption& span,
                   const gap::DiagnosisOptions& options, Parts allowed, Console& console) {
  const auto& file = one.recording.file;
  auto read = one.recording.read_span(console.log, span);
  Series series = of_the_sensor(std::move(read.series), file, console.log);
  require_rate_of(options.claim, series, file);
  const auto share = gap::share_of_reference(series);
  const auto doubt = gap::doubt_of_reference(share);
  if (!doubt.empty()) console.log << fmt::format("{}: {}\n", file, doubt);
  if (gap::is_of_another_axis(share) && doubt.empty()) {
    const auto why = fmt::format(
        "does not turn with rate_ref_dps (by least squares {:.2g} of it), "
        "which is of another axis",
        share.slope);
    if (one.axis_was_chosen)
      throw InputError(file, fmt::format("the gyro {}: give the axis that turns, or a "
                                         "rate_ref_dps of this one",
                                         why));
    console.log << fmt::format("{}: axis {} {}; left out\n", file, one.recording.axis, why);
    return {.file = file};
  }
  auto views = gap::views_of(series);
  LookedAt found{.file = file, .is_whole = views.size() == 1};
  if (found.is_whole) {
    found.members.push_back({.name = one.name, .diagnosis = {}});
    found.series.push_back(std::move(series));
    found.begins_s.push_back(read.begins_s);
  } else {
    if (allowed == Parts::refused)
      throw InputError(file, fmt::format("{} samples; what is of one diagnosis is of up to {}: "
                                         "take a part by --from and --to",
                                         series.size(), gap::most_samples_at_once));
    if (options.claim) std::erase_if(views, [](const auto& view) { return view.mean_of > 1; });
    console.log << fmt::format("{}: {}\n", file, gap::in_words(views, series.size()));
    for (const auto& view : views) {
      auto part = gap::looked_at(series, view);
      const double begun_s = series.t_s.front() - read.begins_s;
      auto name = name_of(view, one.name, part, begun_s);
      if (gap::never_changes(part.gyro_dps)) {
        console.log << fmt::format("{}: the gyro never changes; left out\n", name);
        continue;
      }
      found.members.push_back({.name = std::move(name), .diagnosis = {}, .mean_of = view.mean_of});
      found.begins_s.push_back(part.t_s.front() - begun_s);
      found.series.push_back(std::move(part));
    }
  }
  if (found.members.empty() || (found.is_whole && gap::never_changes(found.series[0].gyro_dps)))
    throw InputError(file, "gyro_dps never changes; there is nothing to diagnose");
  return found;
}

bool diagnose_members(std::vector<LookedAt>& axes, const gap::DiagnosisOptions& options,
                      Console& console) {
  std::vector<LookedAt*> whole;
  for (auto& axis : axes)
    if (axis.is_whole && !axis.members.empty()) whole.push_back(&axis);
  const bool together = whole.size() > 1;
  const Interrupt interrupt(console.stop.orderly(StopSignal::Done::is_discarded));
  try {
    if (together)
      about(whole.front()->file, [&] { diagnose_together(whole, options, interrupt, console); });
    for (auto& axis : axes)
      if (!together || !axis.is_whole)
        about(axis.file, [&] { diagnose_each(axis, options, interrupt, console); });
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

}  // namespace gyrostat::cli
