#include <gyrostat/experiments/findings/recording_page.hpp>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {

std::string recording_page(const std::string& name, const Picture& picture,
                           std::span<const Table> tables) {
  std::string body = "<div class=\"pictures\">\n" + html(picture) + "</div>\n";
  for (const auto& table : tables) body += html(table);
  return live_page(name, fmt::format("<h1>{}</h1>\n", escaped(name)), body);
}

}  // namespace gyrostat
