#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/core/table.hpp>

namespace gyrostat {

enum class Format { text, markdown, csv, json, latex };

/// The format called `name` (text, md, csv, json, latex); throws InputError otherwise.
Format format_named(std::string_view name);
std::vector<std::string> format_names();

/// Tables as text. Readers get four significant digits, programs (csv, json) all seventeen.
///
/// Example: a table for a paper.
///
///   const Table table{.title = "RMSE", .columns = {{"method", ""}, {"rmse", "dps"}},
///                     .rows = {{"kf", 0.021}, {"stf", 0.024}}};
///   std::fputs(render({&table, 1}, Format::latex).c_str(), stdout);
///
/// Thread safety: may run in any number of threads at once.
std::string render(std::span<const Table> tables, Format format);

/// The tables that `render` made JSON of; InputError at `place` for anything else. An infinite
/// number comes back as the text "inf".
std::vector<Table> parse_tables(const std::string& json, const std::string& place);

/// Running text in lines no wider than a screen, each with its end. Its own line breaks and what
/// lines are indented by stay; what a line is broken into stands `further_in` behind the first
/// part.
std::string wrapped(const std::string& text, std::size_t further_in = 0);

namespace render_detail {
std::string text(const Table& table);
std::string markdown(const Table& table);
std::string csv(const Table& table);
std::string latex(const Table& table);
std::string json(std::span<const Table> tables);

/// The text with its line breaks as spaces.
std::string one_line(std::string text);
/// A cell for a reader.
std::string readable(const TableCell& cell);
/// The same where its column is known: a chance ("p") says no more than a test can know.
std::string readable(const TableCell& cell, const TableColumn& column);
/// A cell for a program: numbers that read back as the same bits.
std::string exact(const TableCell& cell);
/// "name [unit]"
std::string head(const TableColumn& column);
}  // namespace render_detail

}  // namespace gyrostat
