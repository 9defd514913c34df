#pragma once

#include <string>
#include <vector>

#include <gyrostat/results/pictures/picture.hpp>
#include <gyrostat/results/pictures/scale.hpp>

namespace gyrostat::render_detail {

/// What a picture is drawn for: a page, which has the style, or a file, which has it not.
enum class Medium { page, file };

/// Where on the drawing everything is, in pixels.
struct Frame {
  Medium medium = Medium::page;
  double width = 0.0, height = 0.0;
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;  ///< margins
  double row = 0.0, column = 0.0;  ///< pixels of one name; 0 on an axis of numbers
  bool above = false;   ///< names of x, as heads of a map that has no other name for them
  bool aslant = false;  ///< names of x, above, where they are too long to lie side by side
  Scale x, y;
  std::vector<std::string> title, note;  ///< of a file, by line
  std::vector<std::string> panels;  ///< names of the marks of each; one without name: all marks

  std::string paint(const std::string& colour) const;
  /// The y scale of a panel.
  Frame panel(std::size_t number) const;
};

Frame frame_of(const Picture& picture, Medium medium);

/// "label [unit]".
std::string head(const PictureAxis& axis);

}  // namespace gyrostat::render_detail
