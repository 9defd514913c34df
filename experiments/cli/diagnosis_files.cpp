#include <gyrostat/experiments/cli/diagnosis_files.hpp>

#include <algorithm>
#include <cctype>
#include <set>

#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/experiments/findings/diagnosis_page.hpp>
#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>
#include <gyrostat/experiments/findings/fleet_page.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

/// The study whose simulator has the effects, under the recording's conditions where these matter.
nlohmann::ordered_json enriched_study(const ToDiagnose& of, const SpanOption& span,
                                      const gap::Diagnosis& diagnosis, const fs::path& out) {
  auto study = gap::scenario_json(diagnosis, called(of));
  if (of.recording.file == "-" || !gap::depends_on_conditions(diagnosis)) return study;
  auto source = of.recording.source_for(fs::absolute(out).parent_path());
  if (span.from_s > 0.0) source["from_s"] = span.from_s;
  if (span.to_s < SpanOption{}.to_s) source["to_s"] = span.to_s;
  study["cells"][0]["scenario"]["conditions_from"] = std::move(source);
  return study;
}

/// "_x" of axis x.
std::string suffix_of(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return '_' + name;
}

fs::path with_suffix(const fs::path& path, const std::string& suffix) {
  return path.parent_path() / (path.stem().string() + suffix + path.extension().string());
}

}  // namespace

bool any(const Given& options) {
  return std::ranges::any_of(options, [](const auto& option) { return option.second; });
}

void refuse(const Given& options, const std::string& why) {
  for (const auto& [option, is_given] : options)
    if (is_given) throw InputError(option, why);
}

std::string called(const ToDiagnose& one) {
  auto name = fs::path(one.recording.file).filename().string();
  if (!one.recording.axis.empty()) name += ", axis " + one.recording.axis;
  return name;
}

void DiagnosisFiles::add_to(CLI::App* verb) {
  verb->add_option("--json", json, "write the diagnosis as JSON");
  verb->add_option("--html", html, "write the diagnosis as a page with pictures");
  verb->add_option("--scenario", scenario, "write a study whose scenario has the effects found");
  verb->add_option("--out-figures", figures,
                   "folder to write every picture of the page to, as SVG");
}

Given DiagnosisFiles::of_each() const {
  return {{"--html", !html.empty()},
          {"--scenario", !scenario.empty()},
          {"--out-figures", !figures.empty()}};
}

TemporaryPath DiagnosisFiles::require_writable_beside(const std::string& recording) const {
  for (const auto& out : {json, html, scenario})
    if (!out.empty()) require_writable(out, recording);
  TemporaryPath made;
  if (const fs::path folder = figures; !folder.empty()) {
    if (!fs::exists(folder)) made = TemporaryPath(folder);
    make_result_folder(folder);
  }
  return made;
}

void DiagnosisFiles::write_one(const ToDiagnose& of, const SpanOption& span,
                               const gap::Diagnosis& diagnosis, const std::string& suffix) const {
  if (!html.empty())
    write_atomically(with_suffix(html, suffix), gap::diagnosis_page(diagnosis, called(of)));
  if (!scenario.empty())
    write_atomically(with_suffix(scenario, suffix),
                     enriched_study(of, span, diagnosis, scenario).dump(2) + '\n');
  if (!figures.empty())
    for (const auto& picture : gap::diagnosis_pictures(diagnosis))
      write_atomically(fs::path(figures) / (picture.id + suffix + ".svg"), picture_file(picture));
}

void DiagnosisFiles::write(const ToDiagnose& of, const SpanOption& span,
                           const gap::Diagnosis& diagnosis) const {
  if (!json.empty()) write_atomically(json, gap::to_json(diagnosis).dump(1) + '\n');
  write_one(of, span, diagnosis);
}

void DiagnosisFiles::write_several(const std::vector<const ToDiagnose*>& of, const SpanOption& span,
                                   const std::vector<gap::FleetMember>& members,
                                   const std::string& kind) const {
  if (!json.empty()) write_atomically(json, members_json(members, kind).dump(1) + '\n');
  if (!any(of_each())) return;
  std::vector<std::string> pages;
  std::set<std::string> suffixes;
  for (std::size_t k = 0; k < members.size(); ++k) {
    auto suffix = suffix_of(members[k].name);
    while (!suffixes.insert(suffix).second) suffix += '_';
    write_one(*of[k], span, members[k].diagnosis, suffix);
    pages.push_back(with_suffix(html, suffix).filename().string());
  }
  if (!html.empty())
    write_atomically(html,
                     gap::fleet_page(members, kind, pages,
                                     fs::path(of.front()->recording.file).filename().string()));
}

}  // namespace gyrostat::cli
