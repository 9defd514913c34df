#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/results/pictures/colours.hpp>
#include <gyrostat/results/pictures/drawing.hpp>
#include <gyrostat/results/pictures/lettering.hpp>
#include <gyrostat/results/pictures/marks.hpp>

namespace gyrostat::render_detail {
namespace {

/// One point of a mark, and where it stands.
struct Point {
  const Mark& mark;
  std::size_t i;
  const Frame& f;
  double x, y;
  std::string colour;

  std::string label() const { return i < mark.labels.size() ? mark.labels[i] : ""; }
};

std::string rectangle(double x, double y, double width, double height, const std::string& style) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"{}\"/>", x, y,
      width, height, style);
}

std::string whiskers(const Point& p, const std::string& colour) {
  const auto& [m, i, f, x, y, own] = p;
  const auto style = "stroke:" + colour;
  std::string out;
  if (f.x.shows(value(m.x_low, i)) && f.x.shows(value(m.x_high, i)) && m.kind != Mark::Kind::boxes)
    out += segment(f.x.at(m.x_low[i]), y, f.x.at(m.x_high[i]), y, style);
  if (f.y.shows(value(m.y_low, i)) && f.y.shows(value(m.y_high, i)))
    out += segment(x, f.y.at(m.y_low[i]), x, f.y.at(m.y_high[i]), style);
  if (f.x.shows(value(m.from, i)) && f.x.shows(value(m.to, i)))
    out += segment(f.x.at(m.from[i]), y, f.x.at(m.to[i]), y, style);
  return out;
}

std::string bar(const Point& p) {
  const double begin = value(p.mark.from, p.i);
  const double half = 0.36 * p.f.row, zero = p.f.x.at(std::isfinite(begin) ? begin : 0.0);
  std::string out = rectangle(std::min(p.x, zero), p.y - half, std::abs(p.x - zero), 2 * half,
                              "fill:" + p.colour + ";fill-opacity:.75");
  if (p.mark.labelled) out += text_at(std::max(p.x, zero) + 5.0, p.y + 4.0, p.label(), "start");
  return out + whiskers(p, p.f.paint("ink"));
}

std::string box(const Point& p) {
  const double half = 0.32 * p.f.row, low = p.f.x.at(p.mark.x_low[p.i]),
               high = p.f.x.at(p.mark.x_high[p.i]);
  return whiskers(p, p.colour) +
         rectangle(low, p.y - half, std::max(high - low, 0.5), 2 * half,
                   fmt::format("fill:{};stroke:{}", p.f.paint("paper"), p.colour)) +
         segment(p.x, p.y - half, p.x, p.y + half, "stroke:" + p.colour + ";stroke-width:2.5");
}

/// In a file a cell is as wide as its number; on a page a number without room is only told.
std::string cell(const Point& p) {
  const auto& f = p.f;
  const auto& fill = p.mark.fills[p.i];
  std::string out = rectangle(p.x - f.column / 2, p.y - f.row / 2, f.column, f.row,
                              fmt::format("fill:{};stroke:{}", f.paint(fill), f.paint("paper")));
  if (length_of(p.label()) < f.column)
    out += text_at(
        p.x, p.y + 4.0, p.label(), "middle",
        fmt::format("fill:{}{}",
                    fill.starts_with('#') ? (is_dark(fill) ? "#fff" : "#111") : f.paint("paper"),
                    p.mark.strong ? ";font-weight:bold" : ""));
  return out;
}

std::string dot(const Point& p, Labels& labels) {
  auto out = whiskers(p, p.colour) +
             fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" style=\"fill:{};stroke:{}\"",
                         p.x, p.y, p.mark.labelled ? 4 : 3,
                         p.mark.dashed ? p.f.paint("paper") : p.colour, p.colour);
  const auto label = p.label();
  if (p.mark.labelled && !label.empty()) labels.add(p.x, p.y, label);
  return out + (label.empty() ? "/>" : fmt::format("><title>{}</title></circle>", escaped(label)));
}

}  // namespace

std::string points(const Mark& mark, const Frame& f, Labels& labels) {
  std::string out;
  for (std::size_t i = 0; i < mark.x.size(); ++i) {
    if (!f.x.shows(mark.x[i]) || !f.y.shows(mark.y[i])) continue;
    const Point p{mark, i, f, f.x.at(mark.x[i]), f.y.at(mark.y[i]), f.paint(mark.colour)};
    switch (mark.kind) {
      case Mark::Kind::bars:
        out += bar(p);
        break;
      case Mark::Kind::boxes:
        out += box(p);
        break;
      case Mark::Kind::cells:
        out += cell(p);
        break;
      default:
        out += dot(p, labels);
    }
  }
  return out;
}

}  // namespace gyrostat::render_detail
