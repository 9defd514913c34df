#pragma once

#include <string>

#include <gyrostat/results/pictures/frame.hpp>

namespace gyrostat::render_detail {

/// Grid, and beside it numbers or names; those of x at the lowest panel only.
std::string grid(const Picture& picture, const Frame& panel, bool lowest);

/// What the axes are called.
std::string axis_heads(const Picture& picture, const Frame& frame);

}  // namespace gyrostat::render_detail
