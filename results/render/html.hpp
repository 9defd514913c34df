#pragma once

#include <string>
#include <string_view>

#include <gyrostat/core/table.hpp>

namespace gyrostat {

/// Text as it may stand in HTML and SVG, attributes included.
std::string escaped(std::string_view text);

/// A table with its title as a caption and its notes below.
std::string html(const Table& table);

/// A whole page that asks no host for anything: its policy forbids it. `extra_style` is CSS beside
/// that of all pages; `body` is HTML.
std::string html_page(std::string_view title, std::string_view extra_style, std::string_view body);

}  // namespace gyrostat
