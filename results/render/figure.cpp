#include <gyrostat/results/render/figure.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <gyrostat/results/render/axis.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

using render_detail::Axis;

/// Okabe and Ito's colours, told apart by every eye.
constexpr std::array colours = {"#888888", "#D55E00", "#0072B2", "#009E73",
                                "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr double width = 760.0, margin_left = 70.0, margin_right = 130.0, margin_top = 40.0;
constexpr double margin_bottom = 48.0;

std::string text_at(double x, double y, const std::string& text, const char* anchor = "start",
                    const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escaped(text));
}

std::string head(double height, const std::string& title) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
             width, height) +
         text_at(margin_left, 22.0, title, "start", " font-size=\"14\"");
}

std::string grid(const Axis& x, const Axis& y, const LineChart& chart, bool with_x) {
  std::string out;
  const double bottom = y.start, top = y.start + y.length, right = x.start + x.length;
  const char* line =
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#dddddd\"/>\n";
  for (const double v : x.ticks()) {
    out += fmt::format(fmt::runtime(line), x.at(v), bottom, x.at(v), top);
    if (with_x) out += text_at(x.at(v), bottom + 16.0, fmt::format("{:g}", v), "middle");
  }
  for (const double v : y.ticks()) {
    out += fmt::format(fmt::runtime(line), x.start, y.at(v), right, y.at(v));
    out += text_at(x.start - 6.0, y.at(v) + 4.0, fmt::format("{:g}", v), "end");
  }
  out += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#555555\"/>\n",
      x.start, top, x.length, -y.length);
  if (with_x) out += text_at(x.start + 0.5 * x.length, bottom + 36.0, chart.x_label, "middle");
  return out;
}

std::string points(const Axis& x, const Axis& y, const std::vector<double>& xs,
                   const std::vector<double>& ys, bool backwards = false) {
  std::string out;
  for (std::size_t k = 0; k < xs.size(); ++k) {
    const std::size_t i = backwards ? xs.size() - 1 - k : k;
    if (!x.shows(xs[i]) || !y.shows(ys[i])) continue;
    out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", x.at(xs[i]), y.at(ys[i]));
  }
  return out;
}

std::string drawn(const LineChart::Line& line, const char* colour, const Axis& x, const Axis& y) {
  std::string out;
  if (!line.low.empty())
    out +=
        fmt::format("<polygon points=\"{} {}\" fill=\"{}\" fill-opacity=\"0.2\"/>\n",
                    points(x, y, line.x, line.low), points(x, y, line.x, line.high, true), colour);
  return out +
         fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"/>\n",
                     points(x, y, line.x, line.y), colour);
}

/// White for a ratio of 1, yellow to red for larger, on a logarithmic scale that ends at 10.
std::string shade(double ratio) {
  if (!std::isfinite(ratio)) return "#ffffff";
  const double t = std::clamp(std::log10(std::max(ratio, 1.0)), 0.0, 1.0);
  const auto mix = [t](double a, double b, double c) {
    const double v = t < 0.5 ? a + 2.0 * t * (b - a) : b + (2.0 * t - 1.0) * (c - b);
    return static_cast<int>(std::lround(v));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(255, 253, 215), mix(255, 174, 48),
                     mix(255, 97, 39));
}

}  // namespace

std::string svg(const LineChart& chart) {
  const int lines = static_cast<int>(chart.lines.size());
  const int panels = chart.panels ? std::max(lines, 1) : 1;
  const double panel = chart.panels ? 110.0 : 360.0, gap = 8.0;
  const double height = margin_top + panels * panel + (panels - 1) * gap + margin_bottom;
  Axis x{.logarithmic = chart.logarithmic,
         .start = margin_left,
         .length = width - margin_left - margin_right};
  Axis y{.logarithmic = chart.logarithmic};
  for (const auto& line : chart.lines) {
    for (const double v : line.x) x.include(v);
    for (const auto* values : {&line.y, &line.low, &line.high})
      for (const double v : *values) y.include(v);
  }
  x.widen();
  y.widen();
  std::string out = head(height, chart.title);
  for (int p = 0; p < panels; ++p) {
    y.start = margin_top + (p + 1) * panel + p * gap;
    y.length = -panel;
    out += grid(x, y, chart, p + 1 == panels);
    for (int l = 0; l < lines; ++l) {
      if (chart.panels && l != p) continue;
      const auto& line = chart.lines[static_cast<std::size_t>(l)];
      const char* colour = colours[static_cast<std::size_t>(l) % colours.size()];
      out += drawn(line, colour, x, y);
      const double row =
          chart.panels ? margin_top + p * (panel + gap) + 16.0 : margin_top + 16.0 + 18.0 * l;
      out +=
          fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"4\" fill=\"{}\"/>\n",
                      width - margin_right + 10.0, row - 6.0, colour);
      out += text_at(width - margin_right + 28.0, row, line.name);
    }
  }
  out += fmt::format(
      "<text transform=\"translate(14,{:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      margin_top + 0.5 * (height - margin_top - margin_bottom), escaped(chart.y_label));
  return out + "</svg>\n";
}

std::string svg(const HeatMap& map) {
  const double left = 250.0, row_height = 18.0, heads = 70.0;
  const double column =
      (width - left - 40.0) / static_cast<double>(std::max<std::size_t>(map.columns.size(), 1));
  const double height =
      margin_top + heads + row_height * static_cast<double>(map.rows.size()) + 30.0;
  std::string out = head(height, map.title);
  const auto across = [&](std::size_t c, double part) {
    return left + (static_cast<double>(c) + part) * column;
  };
  for (std::size_t c = 0; c < map.columns.size(); ++c)
    out += fmt::format(
        "<text transform=\"translate({:.1f},{:.1f}) rotate(-40)\" font-size=\"11\">{}</text>\n",
        across(c, 0.5), margin_top + heads - 6.0, escaped(map.columns[c]));
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    const double y = margin_top + heads + static_cast<double>(r) * row_height;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < map.columns.size(); ++c)
      if (map.ranked[c] && map.values[r][c] < least) least = map.values[r][c];
    out += text_at(left - 8.0, y + 13.0, map.rows[r], "end", " font-size=\"11\"");
    for (std::size_t c = 0; c < map.columns.size(); ++c) {
      const double v = map.values[r][c];
      out += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
          "stroke=\"white\"/>\n",
          across(c, 0.0), y, column, row_height, map.ranked[c] ? shade(v / least) : "#eeeeee");
      out += text_at(across(c, 0.5), y + 13.0, std::isfinite(v) ? fmt::format("{:.3g}", v) : "–",
                     "middle",
                     map.ranked[c] && v == least ? " font-size=\"10\" font-weight=\"bold\""
                                                 : " font-size=\"10\"");
    }
  }
  out += text_at(left, height - 10.0,
                 "bold: lowest of its row; colour: ratio to it, 1 (white) to 10 and above (red)",
                 "start", " font-size=\"11\"");
  return out + "</svg>\n";
}

std::string svg(const RankDiagram& diagram) {
  auto methods = diagram.methods;
  std::erase_if(methods, [](const auto& m) { return !std::isfinite(m.mean_rank); });
  std::stable_sort(methods.begin(), methods.end(),
                   [](const auto& a, const auto& b) { return a.mean_rank < b.mean_rank; });
  // Maximal runs that the critical difference spans; a run that another contains is not drawn.
  std::vector<std::pair<std::size_t, std::size_t>> bars;
  for (std::size_t from = 0, reached = 0; from < methods.size(); ++from) {
    std::size_t to = from;
    while (to + 1 < methods.size() &&
           methods[to + 1].mean_rank - methods[from].mean_rank <= diagram.critical_difference)
      ++to;
    if (to > from && to > reached) bars.emplace_back(from, to);
    reached = std::max(reached, to);
  }
  constexpr double row = 18.0, ruler = 76.0;
  const double line = ruler + 14.0 + 8.0 * static_cast<double>(bars.size());
  const double height = line + row * static_cast<double>(methods.size()) + 20.0;
  Axis x{.from = 1.0,
         .to = std::max<double>(2.0, static_cast<double>(methods.size())),
         .start = margin_left,
         .length = width - margin_left - margin_right};
  const auto segment = [](double x1, double y1, double x2, double y2, double thickness) {
    return fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#222222\" "
        "stroke-width=\"{}\"/>\n",
        x1, y1, x2, y2, thickness);
  };
  std::string out = head(height, diagram.title);
  out += segment(x.at(x.from), ruler, x.at(x.to), ruler, 1.0);
  for (double rank = 1.0; rank <= x.to; rank += 1.0) {
    out += segment(x.at(rank), ruler - 5.0, x.at(rank), ruler, 1.0);
    out += text_at(x.at(rank), ruler - 9.0, fmt::format("{:g}", rank), "middle");
  }
  if (std::isfinite(diagram.critical_difference)) {
    const double end = x.at(1.0 + std::min(diagram.critical_difference, x.to - 1.0));
    out += segment(x.at(1.0), 46.0, end, 46.0, 2.0);
    out += text_at(end + 6.0, 50.0,
                   fmt::format("critical difference {:.3g}", diagram.critical_difference));
  }
  for (std::size_t b = 0; b < bars.size(); ++b) {
    const double y = ruler + 10.0 + 8.0 * static_cast<double>(b);
    out += segment(x.at(methods[bars[b].first].mean_rank) - 3.0, y,
                   x.at(methods[bars[b].second].mean_rank) + 3.0, y, 4.0);
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const double y = line + row * static_cast<double>(m + 1), at = x.at(methods[m].mean_rank);
    out += segment(at, ruler, at, y, 1.0) + segment(at, y, x.at(x.to) + 8.0, y, 1.0);
    out += text_at(x.at(x.to) + 12.0, y + 4.0,
                   fmt::format("{} ({:.2f})", methods[m].name, methods[m].mean_rank));
  }
  return out + "</svg>\n";
}

}  // namespace gyrostat
