#pragma once

#include <string>
#include <vector>

#include <gyrostat/results/pictures/frame.hpp>

namespace gyrostat::render_detail {

/// The first mark of each name that the picture does not itself tell; none for one name alone.
std::vector<const Mark*> legend_of(const Picture& picture);

/// The legend of a file, at the right of the marks it names.
std::string legend_svg(const Picture& picture, const Frame& frame);

/// The legend of a page: one button a name, pressed where its marks are shown.
std::string legend_html(const Picture& picture);

}  // namespace gyrostat::render_detail
