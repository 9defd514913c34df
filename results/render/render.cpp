#include <gyrostat/results/render/render.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/words.hpp>

namespace gyrostat {
namespace {

constexpr std::array<std::pair<std::string_view, Format>, 5> formats = {{
    {"text", Format::text},
    {"md", Format::markdown},
    {"csv", Format::csv},
    {"json", Format::json},
    {"latex", Format::latex},
}};

}  // namespace

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const auto& [name, format] : formats) names.emplace_back(name);
  return names;
}

Format format_named(std::string_view name) {
  for (const auto& [known, format] : formats)
    if (known == name) return format;
  throw InputError("--format", unknown_name("format", name, format_names()));
}

std::string render(std::span<const Table> tables, Format format) {
  using namespace render_detail;
  if (format == Format::json) return json(tables);
  std::string out;
  for (const auto& table : tables) {
    if (!out.empty()) out += '\n';
    switch (format) {
      case Format::markdown:
        out += markdown(table);
        break;
      case Format::csv:
        out += csv(table);
        break;
      case Format::latex:
        out += latex(table);
        break;
      default:
        out += text(table);
        break;
    }
  }
  return out;
}

namespace render_detail {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string readable(const TableCell& cell) {
  struct {
    std::string operator()(std::monostate) const { return "–"; }
    std::string operator()(const std::string& s) const { return one_line(s); }
    std::string operator()(double v) const { return v == v ? fmt::format("{:.4g}", v) : "–"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
  } visitor;
  return std::visit(visitor, cell);
}

std::string readable(const TableCell& cell, const TableColumn& column) {
  const auto* number = std::get_if<double>(&cell);
  const bool is_chance =
      column.name == "p" || column.name.starts_with("p, ") || column.name.starts_with("p ");
  return number && is_chance && *number < least_chance ? chance_in_words(*number) : readable(cell);
}

std::string exact(const TableCell& cell) {
  struct {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(const std::string& s) const { return s; }
    std::string operator()(double v) const { return v == v ? fmt::format("{:.17g}", v) : ""; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
  } visitor;
  return std::visit(visitor, cell);
}

std::string head(const TableColumn& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

}  // namespace render_detail
}  // namespace gyrostat
