#include <gyrostat/results/pictures/frame.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/results/pictures/colours.hpp>
#include <gyrostat/results/pictures/legend.hpp>
#include <gyrostat/results/pictures/lettering.hpp>

namespace gyrostat::render_detail {
namespace {

double longest(const std::vector<std::string>& texts) {
  double most = 0.0;
  for (const auto& text : texts) most = std::max(most, length_of(text));
  return most;
}

double count(const std::vector<std::string>& names) { return static_cast<double>(names.size()); }

bool has_cells(const Picture& picture) {
  return std::any_of(picture.marks.begin(), picture.marks.end(),
                     [](const Mark& m) { return m.kind == Mark::Kind::cells; });
}

/// What the shown marks reach, or from the first name to the last.
void reach(Frame& f, const Picture& picture) {
  f.x.logarithmic = picture.x.logarithmic;
  f.y.logarithmic = picture.y.logarithmic;
  bool labelled_bars = false;
  for (const auto& m : picture.marks) {
    if (!m.shown) continue;
    for (const auto* values : {&m.x, &m.x_low, &m.x_high, &m.from, &m.to})
      for (const double v : *values) f.x.include(v);
    for (const auto* values : {&m.y, &m.y_low, &m.y_high})
      for (const double v : *values) f.y.include(v);
    if (m.kind == Mark::Kind::bars) f.x.include(0.0);
    labelled_bars |= m.kind == Mark::Kind::bars && m.labelled;
  }
  f.x.widen();
  f.y.widen();
  if (labelled_bars) f.x.to += 0.12 * (f.x.to - f.x.from);
  if (!picture.x.names.empty()) f.x.from = -0.5, f.x.to = count(picture.x.names) - 0.5;
  if (!picture.y.names.empty()) f.y.from = count(picture.y.names) - 0.5, f.y.to = -0.5;
}

/// Names of the marks of each panel; one panel without a name holds all marks.
std::vector<std::string> panels_of(const Picture& picture) {
  std::vector<std::string> names;
  for (const auto& m : picture.marks)
    if (picture.panels && m.shown && !m.name.empty() &&
        std::find(names.begin(), names.end(), m.name) == names.end())
      names.push_back(m.name);
  if (names.empty()) names.emplace_back();
  return names;
}

constexpr double panel_gap = 16.0;

/// Every number of a file's map is drawn, so a column is as wide as the longest.
double least_column(const Frame& f, const Picture& picture) {
  double least = 0.0;
  for (const auto& m : picture.marks)
    if (f.medium == Medium::file && m.kind == Mark::Kind::cells)
      least = std::max(least, longest(m.labels) + 12.0);
  return least;
}

void add_names_of_x(Frame& f, const Picture& picture) {
  const double n = count(picture.x.names), name = longest(picture.x.names);
  const double least = least_column(f, picture);
  const auto fit = [&] {
    f.width = std::max(f.width, f.left + least * n + f.right);
    f.column = (f.width - f.left - f.right) / n;
  };
  fit();
  f.aslant = name + 6.0 > f.column;
  f.above = f.aslant || picture.x.label.empty();
  if (f.aslant) f.right = std::max(f.right, 0.77 * name - 0.4 * f.column);
  fit();
  if (f.above) f.top += f.aslant ? 0.64 * name + 10.0 : 14.0;
  if (f.above) f.bottom -= 14.0;
}

void add_words(Frame& f, const Picture& picture) {
  f.title = lines_within(picture.title, 0.85 * (f.width - 28.0));
  f.note = lines_within(picture.note, f.width - 28.0);
  f.top += 12.0 + 19.0 * count(f.title);
  if (!f.note.empty()) f.bottom += 8.0 + 15.0 * count(f.note);
}

void set_height(Frame& f, const Picture& picture) {
  const bool file = f.medium == Medium::file;
  const double names = count(picture.y.names), panels = count(f.panels);
  const double inside = names > 0.0    ? names * (file && has_cells(picture) ? 20.0 : 27.0)
                        : panels > 1.0 ? 110.0 * panels + panel_gap * (panels - 1.0)
                        : file         ? 360.0
                                       : 266.0;
  const double room = std::max(inside, length_of(head(picture.y)) - f.bottom);
  f.height = f.top + room + f.bottom;
  if (names > 0.0) f.row = room / names;
}

}  // namespace

std::string head(const PictureAxis& a) {
  return a.unit.empty() ? a.label : a.label + " [" + a.unit + "]";
}

std::string Frame::paint(const std::string& colour) const {
  if (colour.starts_with('#')) return colour;
  return medium == Medium::file ? light_colour(colour) : fmt::format("var(--{})", colour);
}

Frame Frame::panel(std::size_t number) const {
  Frame one = *this;
  const double all = height - top - bottom, n = count(panels);
  const double each = (all - panel_gap * (n - 1.0)) / n;
  one.y.length = -each;
  one.y.start = top + each + (each + panel_gap) * static_cast<double>(number);
  return one;
}

Frame frame_of(const Picture& picture, Medium medium) {
  const bool file = medium == Medium::file;
  Frame f;
  f.medium = medium;
  f.width = file ? 760.0 : 560.0;
  f.panels = panels_of(picture);
  f.top = 10.0;
  f.bottom = head(picture.x).empty() ? 26.0 : 44.0;
  f.left = std::min((file ? 0.45 : 0.34) * f.width,
                    std::max(longest(picture.y.names), 7.0 * letter) + 10.0) +
           (picture.y.label.empty() ? 0.0 : 18.0);
  std::vector<std::string> named;
  for (const auto* m : legend_of(picture)) named.push_back(m->name);
  f.right = file && !named.empty() ? longest(named) + 40.0 : 14.0;
  if (!picture.x.names.empty()) add_names_of_x(f, picture);
  if (file) add_words(f, picture);
  set_height(f, picture);
  reach(f, picture);
  f.x.start = f.left;
  f.x.length = f.width - f.left - f.right;
  f.y = f.panel(0).y;
  return f;
}

}  // namespace gyrostat::render_detail
