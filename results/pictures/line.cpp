#include <fmt/format.h>

#include <gyrostat/results/pictures/drawing.hpp>
#include <gyrostat/results/pictures/marks.hpp>

namespace gyrostat::render_detail {
namespace {

/// The corners of the band, there along its lower edge and back along its upper one.
std::string corners(const Mark& m, const Frame& f) {
  std::string there, back;
  for (std::size_t i = 0; i < m.x.size(); ++i) {
    const double low = value(m.y_low, i), high = value(m.y_high, i);
    if (!f.x.shows(m.x[i]) || !f.y.shows(m.y[i]) || !f.y.shows(low) || !f.y.shows(high)) continue;
    there += fmt::format("{:.1f},{:.1f} ", f.x.at(m.x[i]), f.y.at(low));
    back = fmt::format("{:.1f},{:.1f} ", f.x.at(m.x[i]), f.y.at(high)) + back;
  }
  return there + back;
}

}  // namespace

std::string line(const Mark& m, const Frame& f) {
  std::string path, out;
  double last = 0.0;
  bool open = false;
  for (std::size_t i = 0; i < m.x.size(); ++i) {
    const bool there = f.x.shows(m.x[i]) && f.y.shows(m.y[i]);
    if (there) {
      const double x = f.x.at(m.x[i]), y = f.y.at(m.y[i]);
      if (open && m.stepped) path += fmt::format("L{:.1f} {:.1f}", x, last);
      path += fmt::format("{}{:.1f} {:.1f}", open ? "L" : "M", x, y);
      last = y;
    }
    open = there;
  }
  if (const auto band = corners(m, f); !band.empty())
    out = fmt::format("<polygon points=\"{}\" style=\"fill:{};fill-opacity:.18\"/>", band,
                      f.paint(m.colour));
  return out + fmt::format("<path d=\"{}\" style=\"fill:none;stroke:{};stroke-width:{}{}\"/>", path,
                           f.paint(m.colour), m.strong ? "4" : "1.6",
                           m.dashed ? ";stroke-dasharray:5 4" : "");
}

}  // namespace gyrostat::render_detail
