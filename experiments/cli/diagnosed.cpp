#include <gyrostat/experiments/cli/diagnosed.hpp>

#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/handling.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

/// Without what is not the sensor's, which is told.
Series at_rest(const Series& recording, const std::string& file, std::ostream& log) {
  std::vector<std::string> told;
  Series series = gap::without_handling(recording, told);
  for (const auto& line : told) log << fmt::format("{}: {}\n", file, line);
  return series;
}

/// Samples [first, first + count).
struct Part {
  std::size_t first, count;
};

std::vector<Part> parts_of(const Series& series) {
  const std::size_t parts = (series.size() + most_samples_at_once - 1) / most_samples_at_once;
  std::vector<Part> all;
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t from = k * series.size() / parts, to = (k + 1) * series.size() / parts;
    all.push_back({from, to - from});
  }
  return all;
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

}  // namespace

std::vector<ToDiagnose> each_of(const RecordingOption& recording,
                                const std::vector<std::string>& further) {
  std::vector<std::string> files = {recording.file};
  files.insert(files.end(), further.begin(), further.end());
  const std::vector<std::string> axes = recording.axis == "all"
                                            ? std::vector<std::string>{"x", "y", "z"}
                                            : std::vector<std::string>{recording.axis};
  std::vector<ToDiagnose> all;
  std::set<std::string> names;
  for (const auto& file : files)
    for (const auto& axis : axes) {
      ToDiagnose one{recording, files.size() == 1 ? axis : fs::path(file).filename().string()};
      if (files.size() > 1 && axes.size() > 1) one.name += ' ' + axis;
      if (!names.insert(one.name).second) one.name = file + (axes.size() > 1 ? ' ' + axis : "");
      one.recording.file = file;
      one.recording.axis = axis;
      all.push_back(std::move(one));
    }
  return all;
}

nlohmann::ordered_json members_json(const std::vector<gap::FleetMember>& members,
                                    const std::string& kind) {
  gap::Json json = {{"each", gap::Json::array()}, {"shared", gap::Json::array()}};
  for (const auto& m : members)
    json["each"].push_back({{kind, m.name}, {"diagnosis", gap::to_json(m.diagnosis)}});
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
  const Interrupt interrupt(console.stop.orderly());
  const Series series = at_rest(one.recording.read(console.log, span), file, console.log);
  require_rate_of(options.claim, series, file);
  const auto parts = parts_of(series);
  if (parts.size() == 1) try {
      interrupt.check();
      auto diagnosis = diagnosis_of(series, file, options, interrupt, console);
      return std::vector{gap::FleetMember{one.name, std::move(diagnosis)}};
    } catch (const Interrupted&) {
      return std::nullopt;
    }
  if (allowed == Parts::refused)
    throw InputError(file, fmt::format("{} samples; what is of one diagnosis is of up to {}: take "
                                       "a part by --from and --to",
                                       series.size(), most_samples_at_once));
  console.log << fmt::format(
      "{}: {} samples are diagnosed in {} parts; what is slower than a part shows with "
      "--resample\n",
      file, series.size(), parts.size());
  std::vector<gap::FleetMember> members;
  for (const auto& [first, count] : parts) {
    const Series part = series.slice(first, count);
    const auto name =
        fmt::format("{}{}{:.6g} to {:.6g} s", one.name, one.name.empty() ? "" : " ",
                    part.t_s.front() - series.t_s.front(), part.t_s.back() - series.t_s.front());
    console.log << name << '\n';
    try {
      auto diagnosis = diagnosis_of(part, file, options, interrupt, console);
      members.push_back({name, std::move(diagnosis)});
    } catch (const Interrupted&) {
      return std::nullopt;
    }
  }
  return members;
}

}  // namespace gyrostat::cli
