#pragma once

#include <string>
#include <string_view>

namespace gyrostat {

/// A page whose pictures move: `head` and `main` are HTML, `about` stands above the licences. Where
/// the program was built without µPlot, or the reader allows no script, the pictures stand still.
std::string live_page(std::string_view title, std::string_view head, std::string_view main,
                      std::string_view about = {});

}  // namespace gyrostat
