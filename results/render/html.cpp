#include <gyrostat/results/render/html.hpp>

#include <fmt/format.h>

#include <gyrostat/results/render/page_style.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

namespace {

/// Words, which begin a line; numbers and counts like 3/80 end one.
bool is_text(const TableCell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text && (text->empty() || text->front() < '0' || text->front() > '9');
}

}  // namespace

std::string html(const Table& table) {
  std::string out = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{0}\">"
      "<table><caption>{0}</caption><thead><tr>",
      escaped(table.title));
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out +=
        fmt::format("<th scope=\"col\"{}>{}</th>",
                    !table.rows.empty() && is_text(table.rows.front()[c]) ? " class=\"text\"" : "",
                    escaped(render_detail::head(table.columns[c])));
  out += "</tr></thead>\n<tbody>";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c)
      out += fmt::format("<{0}>{2}</{1}>",
                         c == 0            ? "th scope=\"row\""
                         : is_text(row[c]) ? "td class=\"text\""
                                           : "td",
                         c == 0 ? "th" : "td",
                         escaped(render_detail::readable(row[c], table.columns[c])));
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
  for (const auto& note : table.notes)
    out += fmt::format("<p class=\"note\">{}</p>\n", escaped(note));
  return out;
}

std::string html_page(std::string_view title, std::string_view extra_style, std::string_view body) {
  constexpr std::string_view policy =
      "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>\n{}{}</style>\n</head>\n"
      "<body>\n{}</body>\n</html>\n",
      policy, escaped(title), page_style, extra_style, body);
}

}  // namespace gyrostat
