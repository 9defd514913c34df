#include <gyrostat/experiments/findings/recording_page.hpp>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {

Picture recording_allan_picture(std::span<const AllanPoint> points,
                                const std::optional<AllanCoefficients>& coefficients,
                                const std::string& title) {
  Picture picture{.id = "allan",
                  .title = title,
                  .note = "Overlapping, with the 95 % interval of each point.",
                  .x = {"averaging time τ", "s", true},
                  .y = {"Allan deviation", "dps", true}};
  Mark measured;
  measured.name = "recording";
  measured.colour = "ink";
  for (const auto& point : points) {
    measured.x.push_back(point.tau_s);
    measured.y.push_back(point.deviation);
    measured.y_low.push_back(point.lower);
    measured.y_high.push_back(point.upper);
  }
  picture.marks.push_back(measured);
  if (!coefficients) return picture;
  Mark fitted;
  fitted.name = "Q, N, B, K and R";
  fitted.colour = "m0";
  fitted.dashed = true;
  fitted.x = measured.x;
  for (const double tau_s : fitted.x) fitted.y.push_back(allan_deviation(*coefficients, tau_s));
  picture.marks.push_back(std::move(fitted));
  picture.note += " Dashed: what the five coefficients of the table amount to.";
  return picture;
}

std::string recording_page(const std::string& name, const Picture& picture,
                           std::span<const Table> tables) {
  std::string body = "<div class=\"pictures\">\n" + html(picture) + "</div>\n";
  for (const auto& table : tables) body += html(table);
  return live_page(name, fmt::format("<h1>{}</h1>\n", escaped(name)), body);
}

}  // namespace gyrostat
