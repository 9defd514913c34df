#include <gyrostat/experiments/findings/report/design_sections.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/experiments/findings/report/design_pictures.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

std::string pictures_section(const std::string& id, const std::string& title,
                             const std::vector<Picture>& pictures) {
  if (pictures.empty()) return "";
  std::string out = fmt::format(
      "<section aria-labelledby=\"{0}\"><h2 id=\"{0}\">{1}</h2>\n<div class=\"pictures\">\n", id,
      escaped(title));
  for (const auto& picture : pictures) out += html(picture);
  return out + "</div></section>\n";
}

}  // namespace

bool serves_a_design(const Study& study, std::size_t cell) {
  const auto* design = design_of(study, cell);
  return design != nullptr && has_sensitivities(design->kind) &&
         !(design->kind == DesignKind::one_at_a_time && cell == design->first_cell);
}

std::vector<DesignSensitivities> by_design(const Study& study, const Store& store) {
  std::vector<DesignSensitivities> designs;
  for (auto& s : sensitivities(study, store)) {
    if (designs.empty() || designs.back().front().design != s.design) designs.emplace_back();
    designs.back().push_back(std::move(s));
  }
  const auto mean = [](const Sensitivity& s) {
    Running over_points;
    for (const double m : s.means) over_points.add(m);
    return over_points.count > 0.0 ? over_points.mean : INFINITY;
  };
  for (auto& design : designs)
    std::stable_sort(design.begin(), design.end(),
                     [&](const auto& a, const auto& b) { return mean(a) < mean(b); });
  return designs;
}

std::string sweep_sections(const Study& study, const std::vector<Sweep>& sweeps,
                           const std::vector<CellSummary>& summaries,
                           const MethodColours& colours) {
  std::string out;
  for (std::size_t first = 0, s = 0; first < sweeps.size(); first = s) {
    std::vector<Picture> pictures;
    for (; s < sweeps.size() && sweeps[s].name == sweeps[first].name; ++s)
      for (auto& picture :
           sweep_pictures(study, sweeps[s], summaries, colours, fmt::format("sweep-{}", s)))
        pictures.push_back(std::move(picture));
    out += pictures_section(fmt::format("sweeps-{}", first),
                            "Over parameters: " + sweeps[first].name, pictures);
  }
  return out;
}

std::string sensitivity_sections(const std::vector<DesignSensitivities>& designs,
                                 const MethodColours& colours) {
  std::string out;
  for (std::size_t d = 0; d < designs.size(); ++d)
    out +=
        pictures_section(fmt::format("design-{}", d), "What matters: " + designs[d].front().design,
                         sensitivity_pictures(designs[d], colours, fmt::format("design-{}", d)));
  return out;
}

}  // namespace gyrostat
