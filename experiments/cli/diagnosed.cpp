#include <gyrostat/experiments/cli/diagnosed.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/handling.hpp>
#include <gyrostat/diagnosis/own_reference.hpp>
#include <gyrostat/diagnosis/views.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

/// Without what is not the sensor's, which is told.
Series at_rest(Series recording, const std::string& file, std::ostream& log) {
  std::vector<std::string> told;
  Series series = gap::without_handling(std::move(recording), told);
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

gap::Diagnosis diagnosis_of(const Series& series, const std::string& file,
                            const gap::DiagnosisOptions& options, const Interrupt& interrupt,
                            Console& console) {
  PhaseProgress progress(console.log, console.log_is_terminal, "diagnose");
  return about(file, [&] {
    return gap::diagnose(
        series, options, [&](const auto& now) { progress.set(now.phase, now.detail, now.share); },
        interrupt);
  });
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

nlohmann::ordered_json members_json(const std::vector<gap::FleetMember>& members,
                                    const std::string& kind) {
  gap::Json json = {{"each", gap::Json::array()}, {"shared", gap::Json::array()}};
  for (const auto& m : members) {
    gap::Json one = {{kind, m.name}};
    if (m.mean_of > 1) one["mean_of"] = m.mean_of;
    one["diagnosis"] = gap::to_json(m.diagnosis);
    json[m.mean_of > 1 ? "means" : "each"].push_back(std::move(one));
  }
  const auto number = [](double value) { return value == value ? gap::Json(value) : gap::Json(); };
  for (const auto& s : gap::shared_effects(members)) {
    gap::Json one = {{"effect", s.effect},
                     {"form", s.form},
                     {"in", s.members},
                     {"parameters", gap::Json::object()}};
    for (const auto& p : s.parameters)
      one["parameters"][p.name] = {
          {"unit", p.unit},
          {"mean", p.mean},
          {"mean_interval", gap::Json::array({number(p.mean_low), number(p.mean_high)})},
          {"spread", number(p.spread)},
          {"spread_interval", gap::Json::array({number(p.spread_low), number(p.spread_high)})},
          {"p_equal", number(p.p_equal)}};
    json["shared"].push_back(std::move(one));
  }
  return json;
}

std::optional<std::vector<gap::FleetMember>> diagnosed(const ToDiagnose& one,
                                                       const SpanOption& span,
                                                       const gap::DiagnosisOptions& options,
                                                       Parts allowed, Console& console) {
  const auto& file = one.recording.file;
  const Interrupt interrupt(console.stop.orderly(StopSignal::Done::is_discarded));
  Series series = at_rest(one.recording.read(console.log, span), file, console.log);
  require_rate_of(options.claim, series, file);
  if (const auto share = gap::share_of_reference(series); gap::is_of_another_axis(share)) {
    const auto why = fmt::format(
        "does not turn with rate_ref_dps (by least squares {:.2g} of it), "
        "which is of another axis",
        share.slope);
    if (one.axis_was_chosen)
      throw InputError(file, fmt::format("the gyro {}: give the axis that turns, or a "
                                         "rate_ref_dps of this one",
                                         why));
    console.log << fmt::format("{}: axis {} {}; left out\n", file, one.recording.axis, why);
    return std::vector<gap::FleetMember>{};
  }
  auto views = gap::views_of(series);
  const bool is_whole = views.size() == 1;
  if (!is_whole && allowed == Parts::refused)
    throw InputError(file, fmt::format("{} samples; what is of one diagnosis is of up to {}: take "
                                       "a part by --from and --to",
                                       series.size(), gap::most_samples_at_once));
  if (options.claim) std::erase_if(views, [](const auto& view) { return view.mean_of > 1; });
  if (!is_whole) console.log << fmt::format("{}: {}\n", file, gap::in_words(views, series.size()));
  std::vector<gap::FleetMember> members;
  std::vector<Series> looked_at;
  for (const auto& view : views) {
    if (is_whole) {
      members.push_back({.name = one.name, .diagnosis = {}});
      looked_at.push_back(std::move(series));
      break;
    }
    auto part = gap::looked_at(series, view);
    auto name = name_of(view, one.name, part, series.t_s.front());
    if (gap::never_changes(part.gyro_dps)) {
      console.log << fmt::format("{}: the gyro never changes; left out\n", name);
      continue;
    }
    members.push_back({.name = std::move(name), .diagnosis = {}, .mean_of = view.mean_of});
    looked_at.push_back(std::move(part));
  }
  if (members.empty())
    throw InputError(file, "gyro_dps never changes; there is nothing to diagnose");
  series = {};  // of a long one, a small part is left to hold
  for (std::size_t k = 0; k < members.size(); ++k) try {
      if (!is_whole) console.log << members[k].name << '\n';
      interrupt.check();
      members[k].diagnosis = diagnosis_of(looked_at[k], file, options, interrupt, console);
    } catch (const Interrupted&) {
      return std::nullopt;
    }
  return members;
}

}  // namespace gyrostat::cli
