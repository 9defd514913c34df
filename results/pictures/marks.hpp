#pragma once

#include <string>

#include <gyrostat/results/pictures/frame.hpp>
#include <gyrostat/results/pictures/labels.hpp>

namespace gyrostat::render_detail {

/// A line with its band.
std::string line(const Mark& mark, const Frame& frame);

/// Points, bars, boxes or cells.
std::string points(const Mark& mark, const Frame& frame, Labels& labels);

}  // namespace gyrostat::render_detail
