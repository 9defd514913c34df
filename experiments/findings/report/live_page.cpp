#include <gyrostat/experiments/findings/report/live_page.hpp>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/assets.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

bool moves() { return !std::string_view(uplot_script).empty(); }

}  // namespace

std::string live_page(std::string_view title, std::string_view head, std::string_view main,
                      std::string_view about) {
  auto body = fmt::format(
      "<a class=\"skip\" href=\"#main\">To the results</a>\n<header>\n{}</header>\n<main "
      "id=\"main\" tabindex=\"-1\">\n{}</main>\n<footer>{}",
      head, main, about);
  if (moves())
    body += fmt::format(
        "<details><summary>Licences</summary><p class=\"note\">Pictures: "
        "µPlot.</p><pre>{}</pre></details>\n",
        escaped(uplot_licence));
  body += "</footer>\n";
  if (moves())
    body += fmt::format("<script>\n{}\n</script>\n<script>\n{}</script>\n", uplot_script,
                        report_script);
  return html_page(title, std::string(uplot_style) + report_style, body);
}

}  // namespace gyrostat
