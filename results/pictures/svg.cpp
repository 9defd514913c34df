#include <fmt/format.h>

#include <gyrostat/results/pictures/axes.hpp>
#include <gyrostat/results/pictures/drawing.hpp>
#include <gyrostat/results/pictures/legend.hpp>
#include <gyrostat/results/pictures/marks.hpp>

namespace gyrostat {
namespace {

using namespace render_detail;

std::string panel(const Picture& picture, const Frame& frame, std::size_t number) {
  const auto& name = frame.panels[number];
  const auto here = frame.panel(number);
  std::string out = grid(picture, here, number + 1 == frame.panels.size());
  Labels labels;
  for (const auto& m : picture.marks) {
    if (!m.shown || !(name.empty() || m.name.empty() || m.name == name)) continue;
    out += m.kind == Mark::Kind::line ? line(m, here) : points(m, here, labels);
  }
  return out + labels.svg(here);
}

std::string drawn(const Picture& picture, const Frame& frame) {
  std::string out = axis_heads(picture, frame);
  for (std::size_t p = 0; p < frame.panels.size(); ++p) out += panel(picture, frame, p);
  return out;
}

}  // namespace

std::string picture_svg(const Picture& picture) {
  const auto frame = frame_of(picture, Medium::page);
  return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">",
                     frame.width, frame.height, escaped(picture.title)) +
         drawn(picture, frame) + "</svg>\n";
}

std::string picture_file(const Picture& picture) {
  const auto frame = frame_of(picture, Medium::file);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"11.5\" "
      "fill=\"{2}\">\n<rect width=\"100%\" height=\"100%\" fill=\"{3}\"/>\n",
      frame.width, frame.height, frame.paint("ink"), frame.paint("paper"));
  double at = 6.0;
  for (const auto& text : frame.title)
    out += text_at(14.0, at += 19.0, text, "start", "font-size:14px") + "\n";
  out += drawn(picture, frame) + legend_svg(picture, frame) + "\n";
  at = frame.height - 15.0 * static_cast<double>(frame.note.size()) + 5.0;
  for (const auto& text : frame.note) {
    out += text_at(14.0, at, text, "start", "fill:" + frame.paint("soft")) + "\n";
    at += 15.0;
  }
  return out + "</svg>\n";
}

}  // namespace gyrostat
