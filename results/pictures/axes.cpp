#include <gyrostat/results/pictures/axes.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/results/pictures/drawing.hpp>
#include <gyrostat/results/pictures/lettering.hpp>

namespace gyrostat::render_detail {
namespace {

/// A number where it hits none of those to its left.
std::string numbers_of_x(const Frame& f, bool lowest) {
  std::string out;
  double free = 0.0;
  for (const double v : f.x.ticks(true)) {
    const double at = f.x.at(v);
    out += segment(at, f.y.start, at, f.y.start + f.y.length, "stroke:" + f.paint("line"));
    const auto text = fmt::format("{:g}", v);
    const double half = 0.5 * length_of(text);
    if (!lowest || at - half < free || at + half > f.width) continue;
    out += text_at(at, f.y.start + 15.0, text, "middle");
    free = at + half + letter;
  }
  return out;
}

std::string names_of_x(const Picture& picture, const Frame& f) {
  std::string out;
  for (std::size_t i = 0; i < picture.x.names.size(); ++i) {
    const double at = f.x.at(static_cast<double>(i));
    if (f.aslant)
      out += fmt::format("<text transform=\"translate({:.1f},{:.1f}) rotate(-40)\">{}</text>",
                         at + 3.0, f.top - 6.0, escaped(picture.x.names[i]));
    else
      out += text_at(at, f.above ? f.top - 6.0 : f.y.start + 15.0, picture.x.names[i], "middle");
  }
  return out;
}

}  // namespace

std::string grid(const Picture& picture, const Frame& f, bool lowest) {
  std::string out;
  if (picture.x.names.empty())
    out += numbers_of_x(f, lowest);
  else if (lowest)
    out += names_of_x(picture, f);
  const double room = f.left - 10.0 - (picture.y.label.empty() ? 0.0 : 18.0);
  const auto along_y = [&](double at, const std::string& text) {
    out += segment(f.left, at, f.width - f.right, at, "stroke:" + f.paint("line")) +
           text_at(f.left - 6.0, at + 4.0, shortened(text, room), "end");
  };
  if (picture.y.names.empty()) {
    double free = f.height;  // the panel above may end close by
    for (const double v : f.y.ticks(true)) {
      const double at = f.y.at(v);
      const bool is_free =
          at + 6.0 <= free && (f.panels.size() < 2 || at > f.y.start + f.y.length + 4.0);
      along_y(at, is_free ? fmt::format("{:g}", v) : "");
      if (is_free) free = at - 7.0;
    }
  }
  for (std::size_t i = 0; i < picture.y.names.size(); ++i)
    along_y(f.y.at(static_cast<double>(i)), picture.y.names[i]);
  return out;
}

std::string axis_heads(const Picture& picture, const Frame& f) {
  std::string out;
  const double below = f.height - f.bottom;
  if (const auto text = head(picture.x); !text.empty()) {
    const double half = std::min(0.5 * f.width, 0.5 * length_of(text));
    out += text_at(std::clamp(f.left + 0.5 * f.x.length, half, f.width - half),
                   below + (f.above ? 22.0 : 36.0), text, "middle");
  }
  if (!picture.y.label.empty()) {
    const auto text = head(picture.y);
    const double half = 0.5 * length_of(text);
    out += fmt::format(
        "<text transform=\"translate(12,{:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        std::max(std::min(0.5 * (below + f.top), f.height - half), half), escaped(text));
  }
  return out;
}

}  // namespace gyrostat::render_detail
