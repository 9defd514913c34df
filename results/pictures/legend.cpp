#include <gyrostat/results/pictures/legend.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/results/pictures/drawing.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::render_detail {

std::vector<const Mark*> legend_of(const Picture& picture) {
  const auto& rows = picture.y.names;
  std::vector<const Mark*> first;
  for (const auto& m : picture.marks) {
    const bool known =
        std::any_of(first.begin(), first.end(), [&](const Mark* f) { return f->name == m.name; });
    const bool told =
        m.labels == std::vector{m.name} ||
        (!picture.exclusive && std::find(rows.begin(), rows.end(), m.name) != rows.end());
    if (!m.name.empty() && !known && !told) first.push_back(&m);
  }
  if (first.size() < 2) first.clear();
  return first;
}

std::string legend_svg(const Picture& picture, const Frame& frame) {
  std::string out;
  double line = frame.top + 14.0;
  for (const auto* m : legend_of(picture)) {
    if (!m->shown) continue;
    for (std::size_t p = 0; frame.panels.size() > 1 && p < frame.panels.size(); ++p)
      if (frame.panels[p] == m->name) {
        const auto panel = frame.panel(p);
        line = panel.y.start + panel.y.length + 14.0;
      }
    const double left = frame.width - frame.right + 10.0;
    out += segment(left, line - 4.0, left + 16.0, line - 4.0,
                   fmt::format("stroke:{};stroke-width:3{}", frame.paint(m->colour),
                               m->dashed ? ";stroke-dasharray:5 4" : "")) +
           text_at(left + 22.0, line, m->name, "start");
    line += 18.0;
  }
  return out;
}

std::string legend_html(const Picture& picture) {
  const auto first = legend_of(picture);
  if (first.empty()) return "";
  std::string out = fmt::format("<div class=\"legend\" role=\"group\" aria-label=\"{}\">",
                                picture.exclusive ? "Show one" : "Show or hide");
  for (const auto* m : first)
    out += fmt::format(
        "<button type=\"button\" data-name=\"{0}\" aria-pressed=\"{1}\"><i "
        "style=\"--c:var(--{2})\"{3}></i>{0}"
        "</button>",
        escaped(m->name), m->shown ? "true" : "false", m->colour,
        m->dashed ? " class=\"dashed\"" : "");
  return out + "</div>\n";
}

}  // namespace gyrostat::render_detail
