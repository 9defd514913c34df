#include <gyrostat/experiments/cli/diagnosed.hpp>

#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/handling.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/findings/shared_effects.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

/// A recording of several, and what it is called among them.
struct Named {
  RecordingOption recording;
  std::string name;
};

std::vector<Named> each_of(const RecordingOption& recording,
                           const std::vector<std::string>& further) {
  std::vector<std::string> files = {recording.file};
  files.insert(files.end(), further.begin(), further.end());
  const std::vector<std::string> axes = recording.axis == "all"
                                            ? std::vector<std::string>{"x", "y", "z"}
                                            : std::vector<std::string>{recording.axis};
  std::vector<Named> all;
  std::set<std::string> names;
  for (const auto& file : files)
    for (const auto& axis : axes) {
      Named one{recording, files.size() == 1 ? axis : fs::path(file).filename().string()};
      if (files.size() > 1 && axes.size() > 1) one.name += ' ' + axis;
      if (!names.insert(one.name).second) one.name = file + (axes.size() > 1 ? ' ' + axis : "");
      one.recording.file = file;
      one.recording.axis = axis;
      all.push_back(std::move(one));
    }
  return all;
}

gap::Json members_json(const std::vector<gap::Member>& members, const std::string& kind) {
  gap::Json json = {{"each", gap::Json::array()}, {"shared", gap::Json::array()}};
  for (const auto& m : members)
    json["each"].push_back({{kind, m.name}, {"diagnosis", gap::to_json(m.diagnosis)}});
  const auto number = [](double value) { return value == value ? gap::Json(value) : gap::Json(); };
  for (const auto& s : gap::shared_effects(members)) {
    gap::Json one = {{"effect", s.effect}, {"in", s.members}, {"parameters", gap::Json::object()}};
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

}  // namespace

std::optional<gap::Diagnosis> diagnosed(const RecordingOption& recording, const SpanOption& span,
                                        const gap::DiagnosisOptions& options, Console& console) {
  const auto& file = recording.file;
  const Interrupt interrupt(console.stop.orderly());
  const auto read = recording.read_all(console.log);
  PhaseProgress progress(console.log, console.log_is_terminal, "diagnose");
  try {
    interrupt.check();
    std::vector<std::string> told;
    const Series series =
        gap::without_handling(cut(gap::on_grid(read.series, file, read.first_row), span.from_s,
                                  span.to_s, file + ": --from, --to"),
                              told);
    for (const auto& line : told) console.log << fmt::format("{}: {}\n", file, line);
    return about(file, [&] {
      return gap::diagnose(
          series, options, [&](const auto& now) { progress.set(now.phase, now.detail, now.share); },
          interrupt);
    });
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

int diagnose_members(const RecordingOption& recording, const std::vector<std::string>& further,
                     const SpanOption& span, const gap::DiagnosisOptions& options, Format format,
                     const std::string& json_out, Console& console) {
  const std::string kind = further.empty() ? "axis" : "sensor";
  std::vector<gap::Member> members;
  for (const auto& one : each_of(recording, further)) {
    console.log << fmt::format("{} {}\n", kind, one.name);
    auto diagnosis = diagnosed(one.recording, span, options, console);
    if (!diagnosis) {
      console.log << "stopped early: nothing was written\n";
      return console.stop.exit_code();
    }
    members.push_back({one.name, std::move(*diagnosis)});
  }
  if (!json_out.empty()) write_atomically(json_out, members_json(members, kind).dump(1) + '\n');
  if (format == Format::text) {
    console.out << gap::shared_in_words(members) << "\n\n";
    for (const auto& m : members)
      console.out << fmt::format("{}: {}\n", m.name, gap::answer(m.diagnosis));
    console.out << '\n';
  }
  console.out << render(gap::member_tables(members, kind), format);
  return complete;
}

}  // namespace gyrostat::cli
