#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <gyrostat/results/render/html.hpp>

namespace gyrostat::render_detail {

inline std::string segment(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" style=\"{}\"/>", x1, y1, x2, y2,
                     style);
}

inline std::string text_at(double x, double y, const std::string& text, const char* anchor,
                           const std::string& style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor,
                     style.empty() ? "" : fmt::format(" style=\"{}\"", style), escaped(text));
}

/// NaN where the list ends before.
inline double value(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gyrostat::render_detail
