#pragma once

#include <string>
#include <vector>

namespace gyrostat {

/// An axis of numbers, or of names: then the number i stands for names[i], from the top or the
/// left.
struct PictureAxis {
  std::string label{}, unit{};
  bool logarithmic = false;
  std::vector<std::string> names{};
};

/// What is drawn in one colour. Marks of one name are one entry of the legend; marks without a name
/// are not in it and always drawn.
struct Mark {
  enum class Kind {
    line,    ///< through the points, with the band y_low to y_high where there is one
    points,  ///< with whiskers x_low to x_high and y_low to y_high where there are
    bars,    ///< from x = 0, or each `from`, to x, in row y, with whiskers x_low to x_high
    boxes,   ///< x_low to x_high with the median x, in row y, with whiskers from to to
    cells,   ///< of a map, each in its own colour from `fills`
  };
  Kind kind = Kind::line;
  std::string name;
  std::string colour;  ///< a custom property of the page's style, as "m0"
  bool shown = true;   ///< before the reader chooses
  bool dashed = false;
  bool stepped = false;   ///< a line that keeps its value until the next point
  bool labelled = false;  ///< labels are drawn, not only told; those of cells always are
  bool strong = false;    ///< a thick line, bold labels
  std::vector<double> x, y;
  std::vector<double> x_low, x_high, y_low, y_high, from, to;
  std::vector<std::string> labels;     ///< by point
  std::vector<std::string> addresses;  ///< by point: what gyrostat replay takes
  std::vector<std::string> fills;      ///< by cell: "#rrggbb" or a custom property
};

/// A picture and its numbers. NaN is no point.
struct Picture {
  std::string id{};  ///< its anchor, and the name of its file of numbers
  std::string title{};
  std::string note{};  ///< how to read it, and of how many trials it is
  PictureAxis x{}, y{};
  std::vector<Mark> marks{};
  bool exclusive = false;  ///< one name at a time
  bool panels = false;     ///< as SVG, a panel for each name, under one another over the same axes
};

/// The picture as it is before anything is chosen, as SVG coloured by the page's style; the same
/// bytes for the same numbers.
std::string picture_svg(const Picture& picture);

/// The same as a file that stands alone: in the colours that the style has in light, with title,
/// legend and note.
std::string picture_file(const Picture& picture);

/// The picture for the page's script, six significant digits, as JSON that may stand in a script
/// element.
std::string picture_json(const Picture& picture);

/// The figure of a page: title, legend, SVG, note and numbers.
std::string html(const Picture& picture);

}  // namespace gyrostat
