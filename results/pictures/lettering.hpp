#pragma once

#include <string>
#include <vector>

namespace gyrostat::render_detail {

constexpr double letter = 7.0;  ///< pixels that a letter takes, about

/// Pixels that a text takes.
double length_of(const std::string& text);

/// The text, or as much of its two ends as has room.
std::string shortened(const std::string& text, double room);

/// Lines of whole words, none longer than the room where its words allow.
std::vector<std::string> lines_within(const std::string& text, double room);

}  // namespace gyrostat::render_detail
