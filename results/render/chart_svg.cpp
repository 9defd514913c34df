#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <gyrostat/results/render/axis.hpp>
#include <gyrostat/results/render/chart.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

using render_detail::Axis;

constexpr double width = 560.0, top = 10.0, bottom = 44.0, right = 14.0, letter = 6.6;

std::string head(const ChartAxis& a) {
  return a.unit.empty() ? a.label : a.label + " [" + a.unit + "]";
}

double head_length(const ChartAxis& a) { return letter * static_cast<double>(head(a).size()); }

/// Everything that a mark is drawn with.
struct Canvas {
  Axis x, y;
  double row = 0.0, column = 0.0;  ///< pixels of one name; 0 on an axis of numbers
};

std::string property(const std::string& colour) {
  return colour.starts_with('#') ? colour : fmt::format("var(--{})", colour);
}

double value(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::numeric_limits<double>::quiet_NaN();
}

std::string segment(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" style=\"{}\"/>", x1, y1, x2, y2,
                     style);
}

std::string text_at(double x, double y, const std::string& text, const char* anchor) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     escaped(text));
}

void include(Axis& axis, const ChartAxis& of, const std::vector<double>& values) {
  if (of.names.empty())
    for (const double v : values) axis.include(v);
}

Canvas canvas_of(const Chart& chart, double left, double height) {
  Canvas c;
  c.x.logarithmic = chart.x.logarithmic;
  c.y.logarithmic = chart.y.logarithmic;
  for (const auto& m : chart.marks) {
    if (!m.shown) continue;
    for (const auto* values : {&m.x, &m.x_low, &m.x_high, &m.from, &m.to})
      include(c.x, chart.x, *values);
    for (const auto* values : {&m.y, &m.y_low, &m.y_high}) include(c.y, chart.y, *values);
    if (m.kind == Mark::Kind::bars) c.x.include(0.0);
  }
  c.x.widen();
  c.y.widen();
  c.x.start = left;
  c.x.length = width - left - right;
  c.y.start = height - bottom;
  c.y.length = -(height - bottom - top);
  const auto by_name = [](Axis& axis, std::size_t names, bool from_top) {
    axis.from = -0.5;
    axis.to = static_cast<double>(names) - 0.5;
    if (from_top) std::swap(axis.from, axis.to);
    return std::abs(axis.length) / static_cast<double>(names);
  };
  if (!chart.x.names.empty()) c.column = by_name(c.x, chart.x.names.size(), false);
  if (!chart.y.names.empty()) c.row = by_name(c.y, chart.y.names.size(), true);
  return c;
}

std::string line(const Mark& m, const Canvas& c) {
  const auto style = fmt::format("fill:none;stroke:{};stroke-width:1.6{}", property(m.colour),
                                 m.dashed ? ";stroke-dasharray:5 4" : "");
  std::string path, upper, band;
  double last = 0.0;
  bool open = false;
  for (std::size_t i = 0; i < m.x.size(); ++i) {
    const bool there = c.x.shows(m.x[i]) && c.y.shows(m.y[i]);
    if (there) {
      const double x = c.x.at(m.x[i]), y = c.y.at(m.y[i]);
      if (open && m.stepped) path += fmt::format("L{:.1f} {:.1f}", x, last);
      path += fmt::format("{}{:.1f} {:.1f}", open ? "L" : "M", x, y);
      last = y;
    }
    open = there;
    const double low = value(m.y_low, i), high = value(m.y_high, i);
    if (!there || !c.y.shows(low) || !c.y.shows(high)) continue;
    band = fmt::format("{:.1f},{:.1f} ", c.x.at(m.x[i]), c.y.at(high)) + band;
    upper += fmt::format("{:.1f},{:.1f} ", c.x.at(m.x[i]), c.y.at(low));
  }
  std::string out;
  if (!band.empty())
    out = fmt::format("<polygon points=\"{}{}\" style=\"fill:{};fill-opacity:.18\"/>", upper, band,
                      property(m.colour));
  return out + fmt::format("<path d=\"{}\" style=\"{}\"/>", path, style);
}

/// Whiskers of one point, where it has any.
std::string whiskers(const Mark& m, std::size_t i, const Canvas& c) {
  const auto style = "stroke:" + property(m.colour);
  std::string out;
  const double x = c.x.at(m.x[i]), y = c.y.at(m.y[i]);
  if (c.x.shows(value(m.x_low, i)) && c.x.shows(value(m.x_high, i)) && m.kind != Mark::Kind::boxes)
    out += segment(c.x.at(m.x_low[i]), y, c.x.at(m.x_high[i]), y, style);
  if (c.y.shows(value(m.y_low, i)) && c.y.shows(value(m.y_high, i)))
    out += segment(x, c.y.at(m.y_low[i]), x, c.y.at(m.y_high[i]), style);
  if (c.x.shows(value(m.from, i)) && c.x.shows(value(m.to, i)))
    out += segment(c.x.at(m.from[i]), y, c.x.at(m.to[i]), y, style);
  return out;
}

/// Where a label of `length` letters goes so that it hits none of those that are there.
struct Labels {
  std::vector<std::array<double, 4>> taken;
  std::string place(double x, double y, const std::string& text) {
    const double w = letter * static_cast<double>(text.size());
    const std::array<std::array<double, 2>, 6> spots = {{{x + 6, y - 17},
                                                         {x - 6 - w, y - 17},
                                                         {x + 7, y - 6},
                                                         {x - 7 - w, y - 6},
                                                         {x - w / 2, y - 20},
                                                         {x - w / 2, y + 7}}};
    for (const auto& [left, up] : spots) {
      const std::array<double, 4> box = {left, up, left + w, up + 13};
      const bool free = left > 0 && left + w < width &&
                        std::none_of(taken.begin(), taken.end(), [&](const auto& b) {
                          return box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3];
                        });
      if (!free) continue;
      taken.push_back(box);
      return text_at(left, up + 10, text, "start");
    }
    return "";
  }
};

bool is_dark(const std::string& fill) {
  if (!fill.starts_with('#')) return true;
  const auto part = [&](std::size_t at) { return std::stoi(fill.substr(at, 2), nullptr, 16); };
  return 0.3 * part(1) + 0.59 * part(3) + 0.11 * part(5) < 140.0;
}

std::string point(const Mark& m, std::size_t i, const Canvas& c, Labels& labels) {
  const double x = c.x.at(m.x[i]), y = c.y.at(m.y[i]);
  const auto colour = property(m.colour);
  std::string out = whiskers(m, i, c);
  switch (m.kind) {
    case Mark::Kind::bars: {
      const double half = 0.36 * c.row, zero = c.x.at(0.0);
      return fmt::format(
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                 "style=\"fill:{};fill-opacity:.75\"/>",
                 std::min(x, zero), y - half, std::abs(x - zero), 2 * half, colour) +
             out;
    }
    case Mark::Kind::boxes: {
      const double half = 0.32 * c.row, low = c.x.at(m.x_low[i]), high = c.x.at(m.x_high[i]);
      return out +
             fmt::format(
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                 "style=\"fill:var(--paper);stroke:{}\"/>",
                 low, y - half, std::max(high - low, 0.5), 2 * half, colour) +
             segment(x, y - half, x, y + half, "stroke:" + colour + ";stroke-width:2.5");
    }
    case Mark::Kind::cells: {
      const auto& fill = m.fills[i];
      out = fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
          "style=\"fill:{};stroke:var(--paper)\"/>",
          x - c.column / 2, y - c.row / 2, c.column, c.row, property(fill));
      if (i < m.labels.size() && letter * static_cast<double>(m.labels[i].size()) < c.column)
        out += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" style=\"fill:{}\">{}</text>", x,
            y + 4, fill.starts_with('#') ? (is_dark(fill) ? "#fff" : "#111") : "var(--paper)",
            escaped(m.labels[i]));
      return out;
    }
    default:
      out +=
          fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" style=\"fill:{};stroke:{}\"/>",
                      x, y, m.labelled ? 4 : 3, m.dashed ? "var(--paper)" : colour, colour);
      if (m.labelled && i < m.labels.size()) out += labels.place(x, y, m.labels[i]);
      return out;
  }
}

std::string axes(const Chart& chart, const Canvas& c) {
  const double base = c.y.start, left = c.x.start;
  std::string out;
  const auto along_x = [&](double at, const std::string& text, bool grid) {
    if (grid) out += segment(at, base, at, top, "stroke:var(--line)");
    out += text_at(at, base + 15.0, text, "middle");
  };
  if (chart.x.names.empty())
    for (const double v : c.x.ticks(true)) along_x(c.x.at(v), fmt::format("{:g}", v), true);
  for (std::size_t i = 0; i < chart.x.names.size(); ++i)
    along_x(c.x.at(static_cast<double>(i)), chart.x.names[i], false);
  const auto along_y = [&](double at, const std::string& text) {
    out += segment(left, at, width - right, at, "stroke:var(--line)") +
           text_at(left - 6.0, at + 4.0, text, "end");
  };
  if (chart.y.names.empty())
    for (const double v : c.y.ticks(true)) along_y(c.y.at(v), fmt::format("{:g}", v));
  for (std::size_t i = 0; i < chart.y.names.size(); ++i)
    along_y(c.y.at(static_cast<double>(i)), chart.y.names[i]);
  const double half_head = std::min(0.5 * width, 0.5 * head_length(chart.x));
  out += text_at(std::clamp(left + 0.5 * c.x.length, half_head, width - half_head), base + 36.0,
                 head(chart.x), "middle");
  if (!chart.y.label.empty()) {
    const double half = 0.5 * head_length(chart.y);
    out += fmt::format(
        "<text transform=\"translate(12,{:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        std::clamp(0.5 * (base + top), half, base + bottom - half), escaped(head(chart.y)));
  }
  return out;
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  std::size_t longest = 7;
  for (const auto& name : chart.y.names) longest = std::max(longest, name.size());
  const double left = std::min(190.0, letter * static_cast<double>(longest) + 10.0) +
                      (chart.y.label.empty() ? 0 : 18);
  const double rows = 27.0 * static_cast<double>(chart.y.names.size());
  const double height =
      std::max(chart.y.names.empty() ? 320.0 : top + rows + bottom, head_length(chart.y));
  const auto canvas = canvas_of(chart, left, height);
  std::string out =
      fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">", width,
                  height, escaped(chart.title));
  out += axes(chart, canvas);
  Labels labels;
  for (const auto& m : chart.marks) {
    if (!m.shown) continue;
    if (m.kind == Mark::Kind::line) {
      out += line(m, canvas);
      continue;
    }
    for (std::size_t i = 0; i < m.x.size(); ++i)
      if (canvas.x.shows(m.x[i]) && canvas.y.shows(m.y[i])) out += point(m, i, canvas, labels);
  }
  return out + "</svg>\n";
}

std::string ramp(double share) {
  if (!(share >= 0.0)) return "line";
  // Cividis (Nunez, Anderton & Renslow, PLOS ONE 13, 2018) at five places.
  static constexpr std::array<std::array<double, 3>, 5> stops = {
      {{0, 34, 78}, {62, 75, 108}, {124, 123, 120}, {187, 175, 113}, {254, 232, 56}}};
  const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(at), stops.size() - 2);
  const auto mix = [&](std::size_t channel) {
    return static_cast<int>(
        std::lround(stops[k][channel] +
                    (at - static_cast<double>(k)) * (stops[k + 1][channel] - stops[k][channel])));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

}  // namespace gyrostat
