#pragma once

#include <array>
#include <string>
#include <vector>

#include <gyrostat/results/pictures/frame.hpp>

namespace gyrostat::render_detail {

/// Names beside points. They go where they hit neither each other, nor a point, nor the rim; one
/// that finds no place is not drawn.
class Labels {
 public:
  void add(double x, double y, const std::string& text);
  std::string svg(const Frame& frame) const;

 private:
  struct Label {
    double x, y;
    std::string text;
  };
  std::vector<Label> labels_;
};

}  // namespace gyrostat::render_detail
