#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/results/render/chart.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

/// One button for each name that the picture does not itself tell, pressed where its marks are
/// shown.
std::string legend(const Chart& chart) {
  const auto& rows = chart.y.names;
  std::vector<const Mark*> first;
  for (const auto& m : chart.marks) {
    const bool known =
        std::any_of(first.begin(), first.end(), [&](const Mark* f) { return f->name == m.name; });
    const bool told =
        m.labels == std::vector{m.name} ||
        (!chart.exclusive && std::find(rows.begin(), rows.end(), m.name) != rows.end());
    if (!m.name.empty() && !known && !told) first.push_back(&m);
  }
  if (first.size() < 2) return "";
  std::string out = fmt::format("<div class=\"legend\" role=\"group\" aria-label=\"{}\">",
                                chart.exclusive ? "Show one" : "Show or hide");
  for (const auto* m : first)
    out += fmt::format(
        "<button type=\"button\" data-name=\"{0}\" aria-pressed=\"{1}\"><i "
        "style=\"--c:var(--{2})\"{3}></i>{0}"
        "</button>",
        escaped(m->name), m->shown ? "true" : "false", m->colour,
        m->dashed ? " class=\"dashed\"" : "");
  return out + "</div>\n";
}

}  // namespace

std::string html(const Chart& chart) {
  return fmt::format(
      "<figure class=\"chart\" id=\"{0}\">\n<figcaption><h3 "
      "id=\"{0}-title\">{1}</h3></figcaption>\n{2}"
      "<div class=\"plot\" tabindex=\"0\" role=\"group\" aria-roledescription=\"chart\" "
      "aria-labelledby=\"{0}-title\" aria-describedby=\"{0}-note\">\n{3}</div>\n"
      "<p class=\"note\" id=\"{0}-note\">{4}</p>\n<script "
      "type=\"application/json\">{5}</script>\n</figure>\n",
      escaped(chart.id), escaped(chart.title), legend(chart), chart_svg(chart), escaped(chart.note),
      chart_json(chart));
}

}  // namespace gyrostat
